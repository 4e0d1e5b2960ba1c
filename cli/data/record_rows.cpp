#include "cli/data/record_rows.h"

#include "cli/base/exit_code.h"

#include <algorithm>

namespace cli {
namespace {

constexpr std::size_t most_rows_at_a_time = 1024;

class RecordReader {
public:
    RecordReader(std::span<const RecordStream> streams, std::uint64_t count, ParticleRows &rows) :
        streams_(streams),
        count_(count),
        rows_(rows),
        batch_(most_rows_at_a_time) {
        for (const RecordStream &each : streams_) {
            if (each.record_size > DataStream::longest) {
                throw Failure(ExitCode::scene, each.stream->name() + ": each particle has " +
                                                   std::to_string(each.record_size) + " bytes, may have " +
                                                   std::to_string(DataStream::longest));
            }
            batch_ = std::min(batch_, DataStream::longest / std::max<std::size_t>(each.record_size, 1));
        }
        values_.resize(batch_ * rows.row_size());
    }

    void read_all() {
        rows_.set_place([this](std::uint32_t slot) { return place_of(slot); });
        for (; done_ < count_; done_ += batch_count_) {
            batch_count_ = static_cast<std::size_t>(std::min<std::uint64_t>(batch_, count_ - done_));
            for (const RecordStream &each : streams_) {
                read_batch(each);
            }
            for (row_ = 0; row_ < batch_count_; ++row_) {
                double *row = &values_[row_ * rows_.row_size()];
                rows_.require_finite(row);
                rows_.add(row);
            }
        }
    }

private:
    void read_batch(const RecordStream &records) {
        const std::size_t wanted = batch_count_ * records.record_size;
        const std::string_view bytes = records.stream->take(wanted);
        if (bytes.size() < wanted) {
            refuse_missing_records(*records.stream, done_ + bytes.size() / records.record_size, count_);
        }
        for (const RecordField &field : records.fields) {
            read_binary_numbers(bytes.data() + field.offset, records.record_size, field.format,
                                values_.data() + field.slot, rows_.row_size(), batch_count_);
        }
    }

    // Where the stream is now the batch has ended.
    std::string place_of(std::uint32_t slot) const {
        for (const RecordStream &each : streams_) {
            for (const RecordField &field : each.fields) {
                if (field.slot == slot) {
                    return each.stream->byte_place(each.stream->offset() - (batch_count_ - row_) * each.record_size +
                                                   field.offset);
                }
            }
        }
        return streams_.front().stream->byte_place();
    }

    std::span<const RecordStream> streams_;
    std::uint64_t count_;
    ParticleRows &rows_;
    std::size_t batch_;
    std::vector<double> values_;
    std::uint64_t done_ = 0;
    std::size_t batch_count_ = 0;
    std::size_t row_ = 0; // of the batch
};

} // namespace

void read_records(std::span<const RecordStream> streams, std::uint64_t count, ParticleRows &rows) {
    RecordReader(streams, count, rows).read_all();
}

void refuse_missing_records(const DataStream &stream, std::uint64_t count, std::uint64_t expected) {
    throw Failure(ExitCode::scene, stream.byte_place() + ": the file ends after " + std::to_string(count) + " of " +
                                       std::to_string(expected) + " particles: it was cut short");
}

} // namespace cli
