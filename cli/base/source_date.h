// The date in the metadata of images. By default there is none, so that equal runs give equal files; builds that need
// one give it by SOURCE_DATE_EPOCH (reproducible-builds.org/specs/source-date-epoch), in seconds since 1970.
#pragma once

#include <string>

namespace cli {

// "2001:09:09 01:46:40", the form of DateTime in TIFF and of capDate in OpenEXR, in UTC; empty without that variable.
// Throws Failure(ExitCode::usage) if it is not such a number, as the specification asks.
std::string source_date();

} // namespace cli
