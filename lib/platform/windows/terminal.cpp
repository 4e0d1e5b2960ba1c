#include "lib/platform/terminal.h"

#include "lib/platform/file.h"
#include "lib/platform/windows/windows.h"

#include <fcntl.h>
#include <io.h>

namespace platform {
namespace {

bool (*end_of_process)(int) = nullptr;

// Runs on a thread of its own. The process ends after FALSE is returned.
BOOL WINAPI note_end(DWORD event) {
    const bool is_key = event == CTRL_C_EVENT || event == CTRL_BREAK_EVENT;
    if (end_of_process(is_key ? interruption : hangup))
        return FALSE;
    if (!is_key) // the process ends when this function returns, or after some seconds
        Sleep(INFINITE);
    return TRUE;
}

HANDLE errors() {
    return GetStdHandle(STD_ERROR_HANDLE);
}

} // namespace

void prepare_streams() {
    for (const int stream : {standard_input, standard_output, standard_error})
        _setmode(stream, _O_BINARY);
    SetConsoleOutputCP(CP_UTF8);
    DWORD mode = 0;
    if (GetConsoleMode(errors(), &mode))
        SetConsoleMode(errors(), mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
}

bool is_terminal(int stream) {
    DWORD mode = 0;
    return GetConsoleMode(reinterpret_cast<HANDLE>(_get_osfhandle(stream)), &mode) != 0;
}

std::size_t terminal_columns() {
    CONSOLE_SCREEN_BUFFER_INFO info{};
    return GetConsoleScreenBufferInfo(errors(), &info) ? static_cast<std::size_t>(info.dwSize.X) : 0;
}

void catch_signals(bool (*end)(int), void (*)()) {
    end_of_process = end;
    SetConsoleCtrlHandler(&note_end, TRUE);
}

} // namespace platform
