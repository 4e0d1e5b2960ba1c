// Dumps of LAMMPS as text (docs.lammps.org/dump.html), of the styles atom and custom.
#pragma once

#include "cli/data/frame_file.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

class LammpsDump : public FrameFile {
public:
    using FrameFile::FrameFile;

    bool next() override;
    void skip() override;
    void read(ParticleRows &rows) override;

private:
    void read_item(std::string_view item); // "NUMBER OF ATOMS"
    void read_box(std::string_view flags); // what follows BOX BOUNDS
    std::vector<std::vector<double>> read_box_lines(std::size_t count);
    std::string_view require_line();
    [[noreturn]] void refuse(const std::string &what) const;

    std::optional<std::uint64_t> count_;
    std::optional<SimulationBox> box_;
    std::vector<std::string> columns_;
    bool has_columns_ = false;
};

} // namespace cli
