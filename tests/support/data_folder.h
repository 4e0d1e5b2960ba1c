// The folder tests/data. Its path is compiled into one source, because compiler caches miss where paths differ.
#pragma once

#include <string>

std::string data_folder();
