#include "cli/data/decompression.h"

#include "cli/base/exit_code.h"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <limits>
#include <new>
#include <utility>
#include <vector>

namespace cli {
namespace {

constexpr std::size_t packed_block = std::size_t{1} << 16;

// What both kinds of compression do: they take blocks of packed bytes and tell of what is damaged.
class Unpacking : public ByteSource {
protected:
    Unpacking(std::unique_ptr<ByteSource> packed, std::string name) :
        source_(std::move(packed)),
        name_(std::move(name)),
        block_(packed_block) {}

    // The next packed bytes; none at the end.
    std::string_view next_block() { return {block_.data(), source_->read(block_.data(), block_.size())}; }

    [[noreturn]] void refuse(const std::string &reason) const {
        throw Failure(ExitCode::scene, name_ + ": damaged: " + reason);
    }
    [[noreturn]] void refuse_end() const {
        throw Failure(ExitCode::scene, name_ + ": cut short: the compressed data end in the middle");
    }

private:
    std::unique_ptr<ByteSource> source_;
    std::string name_;
    std::vector<char> block_;
};

class Inflating : public Unpacking {
public:
    // gzip: of one or more members with checksums, or else a bare deflate stream.
    Inflating(std::unique_ptr<ByteSource> packed, std::string name, bool gzip) :
        Unpacking(std::move(packed), std::move(name)),
        gzip_(gzip) {
        constexpr int gzip_window = 16 + MAX_WBITS; // zlib.h: adding 16 asks for gzip, negative for a bare stream
        if (inflateInit2(&stream_, gzip ? gzip_window : -MAX_WBITS) != Z_OK) {
            throw std::bad_alloc();
        }
    }
    ~Inflating() override { inflateEnd(&stream_); }

    std::size_t read(char *bytes, std::size_t size) override {
        const auto wanted = static_cast<uInt>(std::min<std::size_t>(size, std::numeric_limits<uInt>::max()));
        stream_.next_out = reinterpret_cast<Bytef *>(bytes);
        stream_.avail_out = wanted;
        while (stream_.avail_out == wanted && !at_end_) {
            if (stream_.avail_in == 0) {
                refill();
            }
            if (!at_end_) {
                step();
            }
        }
        return wanted - stream_.avail_out;
    }

private:
    void refill() {
        const std::string_view block = next_block();
        if (block.empty() && !between_members_) {
            refuse_end();
        }
        at_end_ = block.empty();
        stream_.next_in = reinterpret_cast<Bytef *>(const_cast<char *>(block.data())); // zlib does not write to it
        stream_.avail_in = static_cast<uInt>(block.size());
    }

    void step() {
        between_members_ = false;
        const int result = inflate(&stream_, Z_NO_FLUSH);
        if (result == Z_STREAM_END) {
            end_member();
        } else if (result != Z_OK && result != Z_BUF_ERROR) { // that one asks for more input
            refuse(stream_.msg == nullptr ? "no deflate stream" : stream_.msg);
        }
    }

    void end_member() {
        between_members_ = gzip_;
        at_end_ = !gzip_;
        if (gzip_ && inflateReset(&stream_) != Z_OK) {
            refuse("no further gzip member can be read");
        }
    }

    bool gzip_;
    z_stream stream_{};
    bool between_members_ = false;
    bool at_end_ = false;
};

class ZstdBytes : public Unpacking {
public:
    ZstdBytes(std::unique_ptr<ByteSource> packed, std::string name) :
        Unpacking(std::move(packed), std::move(name)),
        context_(ZSTD_createDCtx(), &ZSTD_freeDCtx) {
        if (!context_) {
            throw std::bad_alloc();
        }
    }

    std::size_t read(char *bytes, std::size_t size) override {
        ZSTD_outBuffer output{bytes, size, 0};
        while (output.pos == 0) {
            // A step may have filled the output and left more to be flushed, without input.
            if (input_.pos == input_.size && !may_have_more_) {
                const std::string_view block = next_block();
                if (block.empty()) {
                    if (!between_frames_) {
                        refuse_end();
                    }
                    return 0;
                }
                input_ = {block.data(), block.size(), 0};
            }
            const std::size_t result = ZSTD_decompressStream(context_.get(), &output, &input_);
            if (ZSTD_isError(result) != 0) {
                refuse(ZSTD_getErrorName(result));
            }
            between_frames_ = result == 0;
            may_have_more_ = output.pos == output.size && !between_frames_;
        }
        return output.pos;
    }

private:
    std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context_;
    ZSTD_inBuffer input_{nullptr, 0, 0};
    bool between_frames_ = false;
    bool may_have_more_ = false;
};

} // namespace

Compression compression_of(std::string_view head) {
    using namespace std::string_view_literals;
    if (head.starts_with("\x1f\x8b"sv)) {
        return Compression::gzip;
    }
    return head.starts_with("\x28\xb5\x2f\xfd"sv) ? Compression::zstd : Compression::none;
}

std::unique_ptr<ByteSource> unpacked(std::unique_ptr<ByteSource> packed, Compression compression,
                                     const std::string &name) {
    if (compression == Compression::zstd) {
        return std::make_unique<ZstdBytes>(std::move(packed), name);
    }
    return std::make_unique<Inflating>(std::move(packed), name, compression == Compression::gzip);
}

} // namespace cli
