#include "cli/data/particle_file.h"

#include "cli/base/report_file.h"
#include "cli/base/suggestion.h"
#include "cli/data/csv_file.h"
#include "cli/data/data_stream.h"
#include "cli/data/lammps_dump.h"
#include "cli/data/numpy_files.h"
#include "cli/data/particle_rows.h"
#include "cli/data/ply_file.h"
#include "cli/data/xyz_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <utility>

namespace cli {
namespace {

struct FormatSign {
    std::string_view sign; // first bytes, or the ending of a name
    std::string_view format;
};

constexpr std::array<FormatSign, 6> first_bytes{{{"\x93NUMPY", "npy"},
                                                 {"PK\3\4", "npz"},
                                                 {"PK\5\6", "npz"},
                                                 {"ply\n", "ply"},
                                                 {"ply\r", "ply"},
                                                 {"ITEM: ", "lammps"}}};

constexpr std::array<FormatSign, 10> endings{{{".dump", "lammps"},
                                              {".lammpstrj", "lammps"},
                                              {".lammps", "lammps"},
                                              {".xyz", "xyz"},
                                              {".extxyz", "xyz"},
                                              {".ply", "ply"},
                                              {".csv", "csv"},
                                              {".tsv", "tsv"},
                                              {".npy", "npy"},
                                              {".npz", "npz"}}};

std::string name_for_messages(const std::string &path) {
    return path == standard_stream ? "standard input" : path;
}

// Behind the byte order mark of UTF-8 that some editors put in front of text.
std::unique_ptr<DataStream> open_stream(const std::string &path) {
    constexpr std::string_view mark = "\xef\xbb\xbf";
    auto stream = std::make_unique<DataStream>(name_for_messages(path), open_bytes(path));
    const std::string_view begin = stream->peek(mark.size());
    if (begin.starts_with("\xff\xfe") || begin.starts_with("\xfe\xff")) {
        throw Failure(ExitCode::scene, stream->name() + ": is UTF-16: save it as UTF-8");
    }
    if (begin == mark) {
        stream->take(mark.size());
    }
    return stream;
}

std::string list_of_formats() {
    std::string list;
    for (const std::string_view format : particle_formats) {
        list.append(list.empty() ? "" : ", ").append(format);
    }
    return list;
}

// The ending of the name in small letters, without that of a compression.
std::string ending_of(const std::string &path) {
    std::filesystem::path name = std::filesystem::path(path).filename();
    if (name.extension() == ".gz" || name.extension() == ".zst") {
        name = name.stem();
    }
    std::string ending = name.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

std::string_view format_of(const std::string &path, const ParticleQuery &query, DataStream &stream) {
    if (!query.format.empty()) {
        const auto *found = std::find(particle_formats.begin(), particle_formats.end(), query.format);
        if (found == particle_formats.end()) {
            throw Failure(query.blame, unknown_name("format", query.format, particle_formats));
        }
        return *found;
    }
    constexpr std::size_t longest_sign = 6;
    const std::string_view begin = stream.peek(longest_sign);
    for (const FormatSign &each : first_bytes) {
        if (begin.starts_with(each.sign)) {
            return each.format;
        }
    }
    const std::string ending = ending_of(path);
    const auto *found =
        std::find_if(endings.begin(), endings.end(), [&ending](const FormatSign &each) { return each.sign == ending; });
    if (found == endings.end()) {
        throw Failure(ExitCode::scene, stream.name() + ": neither its first bytes nor its name say which of " +
                                           list_of_formats() + " it is");
    }
    return found->format;
}

void require_single_frame(const std::string &file, const ParticleQuery &query) {
    if (query.frame != 0 && query.frame != -1) {
        throw Failure(query.blame,
                      file + ": frame " + std::to_string(query.frame) + ": the file has one frame, 0 or -1");
    }
}

std::unique_ptr<FrameFile> frame_file(std::string_view format, std::unique_ptr<DataStream> stream) {
    if (format == "lammps") {
        return std::make_unique<LammpsDump>(std::move(stream));
    }
    return std::make_unique<XyzFile>(std::move(stream));
}

[[noreturn]] void refuse_frame(const std::string &file, const ParticleQuery &query, std::int64_t count) {
    const std::string range =
        count == 0 ? "" : ", from 0 or " + std::to_string(-count) + " to " + std::to_string(count - 1);
    throw Failure(count == 0 ? ExitCode::scene : query.blame, file + ": frame " + std::to_string(query.frame) +
                                                                  ": the file has " + std::to_string(count) +
                                                                  (count == 1 ? " frame" : " frames") + range);
}

// Which frames are counted from the end is known when all have been passed. Where a file can be read once alone the
// last frame is the one that was read last.
void read_last_frame(FrameFile &frames, const std::string &file, const ParticleQuery &query, ParticleRows &rows) {
    if (query.frame != -1) {
        throw Failure(query.blame, file + ": frame " + std::to_string(query.frame) +
                                       ": of what is no file that can be read twice, it must be -1 or at least 0");
    }
    bool has_frame = false;
    for (; frames.next(); has_frame = true) {
        frames.read(rows);
    }
    if (!has_frame) {
        refuse_frame(file, query, 0);
    }
}

struct FrameCount {
    std::int64_t count;
    DataStream::Place wanted; // of the frame that is wanted, if there are so many
};

// frame: that is wanted, as ParticleQuery has it, below 0.
FrameCount count_frames(FrameFile &frames, std::int64_t frame) {
    FrameCount found{0, {}};
    std::deque<DataStream::Place> last;
    for (DataStream::Place place = frames.place(); frames.next(); place = frames.place()) {
        frames.skip();
        ++found.count;
        last.push_back(place);
        if (-found.count < frame) {
            last.pop_front();
        }
    }
    found.wanted = last.empty() ? DataStream::Place{} : last.front();
    return found;
}

// index: from 0.
void read_frame(FrameFile &frames, std::int64_t index, const std::string &file, const ParticleQuery &query,
                ParticleRows &rows) {
    std::int64_t count = 0;
    for (; frames.next(); ++count) {
        if (count == index) {
            frames.read(rows);
            return;
        }
        frames.skip();
    }
    refuse_frame(file, query, count);
}

// Whether the file has one frame alone, which then has been read.
bool read_only_frame(FrameFile &frames, ParticleRows &rows) {
    try {
        if (!frames.next()) {
            return false;
        }
        frames.read(rows);
        return !frames.next();
    } catch (const Failure &) { // of a frame that may be followed by the one that is wanted
        return false;
    }
}

void read_frames(const std::string &path, std::string_view format, std::unique_ptr<DataStream> stream,
                 const ParticleQuery &query, ParticleRows &rows) {
    const std::string file = stream->name();
    const bool is_packed = !stream->size_left();
    auto frames = frame_file(format, std::move(stream));
    if (query.frame >= 0) {
        read_frame(*frames, query.frame, file, query, rows);
    } else if (!is_regular_file(path)) {
        read_last_frame(*frames, file, query, rows);
    } else {
        // What is packed is unpacked twice if frames are to be counted, and most often there is one.
        if (is_packed && query.frame == -1) {
            if (read_only_frame(*frames, rows)) {
                return;
            }
            frames = frame_file(format, open_stream(path));
        }
        const FrameCount found = count_frames(*frames, query.frame);
        if (query.frame < -found.count) {
            refuse_frame(file, query, found.count);
        }
        if (frames->go_to(found.wanted)) {
            read_frame(*frames, 0, file, query, rows);
        } else {
            read_frame(*frame_file(format, open_stream(path)), query.frame + found.count, file, query, rows);
        }
    }
}

} // namespace

Particles read_particles(const std::string &path, const ParticleQuery &query) {
    auto stream = open_stream(path);
    const std::string file = stream->name();
    const std::string_view format = format_of(path, query, *stream);
    ParticleRows rows(file, query);
    if (format == "lammps" || format == "xyz") {
        read_frames(path, format, std::move(stream), query, rows);
        return rows.finish();
    }
    require_single_frame(file, query);
    if (format == "ply") {
        read_ply(std::move(stream), rows);
    } else if (format == "csv") {
        read_csv(*stream, rows);
    } else if (format == "tsv") {
        read_tsv(*stream, rows);
    } else if (format == "npy") {
        read_npy(path, std::move(stream), rows);
    } else {
        read_npz(path, rows);
    }
    return rows.finish();
}

} // namespace cli
