// XYZ, and extended XYZ, whose second line says what the columns are
// (docs.ase-lib.org/ase/io/formatoptions.html#extxyz).
#pragma once

#include "cli/data/frame_file.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

class XyzFile : public FrameFile {
public:
    using FrameFile::FrameFile;

    bool next() override;
    void skip() override;
    void read(ParticleRows &rows) override;

private:
    void read_comment(std::string_view comment);
    void name_columns(const std::string &properties);
    void name_plain_columns();
    std::vector<double> numbers_of(const std::string &key, const std::string &value, std::size_t count) const;
    [[noreturn]] void refuse(const std::string &what) const;

    std::uint64_t count_ = 0;
    std::optional<SimulationBox> box_;
    std::vector<std::string> columns_;
    bool is_plain_ = true;
};

} // namespace cli
