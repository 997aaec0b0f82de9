#include "image/exr_scanline_reader.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

namespace shoal {
namespace {

// Chunks this far apart in all are still fetched with one read.
constexpr std::uint64_t kFetchedInVain = 1 << 16;

std::int32_t read_i32(const std::byte* at) {
  std::int32_t value = 0;
  std::memcpy(&value, at, sizeof value);
  return value;
}

}  // namespace

bool ExrScanlineReader::can_read(const ExrPart& part, const ExrColour& colour) {
  return part.storage == ExrStorage::scanlines && !part.has_subsampling() &&
         colour.model != ExrColourModel::luminance_chroma &&
         ExrInflater::can_expand(part.compression);
}

ExrScanlineReader::ExrScanlineReader(std::shared_ptr<const ExrPicture> picture_in)
    : ExrBandReader(std::move(picture_in)),
      types_(picture().part.sample_types()),
      inflater_(picture().part.compression, picture().codecs) {
  const auto width = static_cast<std::size_t>(layout().data_width);
  const std::vector<ExrChannel>& channels = picture().part.channels;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    for (int c = 0; c < picture().colour.channel_count(); ++c) {
      if (picture().colour.channels[c] == static_cast<int>(i)) {
        in_line_[c] = static_cast<std::ptrdiff_t>(line_bytes_);
      }
    }
    line_bytes_ += width * sample_size(channels[i].type);
  }
  if (!layout().covers_width()) widened_.emplace(picture());
}

Status ExrScanlineReader::decode(const ExrBand& band, RowBand& rows) {
  SHOAL_RETURN_IF_ERROR(fetch(band));
  if (const auto lines = lines_as_fetched(band)) {
    show(band, *lines, rows);
    return {};
  }
  SHOAL_ASSIGN_OR_RETURN(lines, expand(band));
  show(band, lines, rows);
  return {};
}

// Reads the band's chunks, at once where they lie side by side in the file.
Status ExrScanlineReader::fetch(const ExrBand& band) {
  std::uint64_t begin = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t end = 0;
  std::uint64_t total = 0;
  for (int chunk = band.chunk_begin; chunk < band.chunk_end; ++chunk) {
    const ExrChunkTable::Extent& extent = picture().chunks[chunk];
    if (extent.size() == 0) return damaged(chunk, "are missing from the file");
    begin = std::min(begin, extent.begin);
    end = std::max(end, extent.end);
    total += extent.size();
  }
  const bool at_once = end - begin <= total + kFetchedInVain;
  fetched_.resize_uninitialised(at_once ? end - begin : total);
  const InputFile& file = picture().context->file();
  if (at_once) SHOAL_RETURN_IF_ERROR(file.read_exactly(begin, fetched_.span()));

  packed_.clear();
  std::size_t filled = 0;
  for (int chunk = band.chunk_begin; chunk < band.chunk_end; ++chunk) {
    const ExrChunkTable::Extent& extent = picture().chunks[chunk];
    const std::span<std::byte> bytes = fetched_.span().subspan(
        at_once ? extent.begin - begin : filled, static_cast<std::size_t>(extent.size()));
    if (!at_once) SHOAL_RETURN_IF_ERROR(file.read_exactly(extent.begin, bytes));
    filled += bytes.size();
    SHOAL_ASSIGN_OR_RETURN(packed, open_chunk(chunk, bytes));
    packed_.push_back(packed);
  }
  return {};
}

// Checks the chunk's leader (part number, first line, size) and returns what follows it.
Result<std::span<const std::byte>> ExrScanlineReader::open_chunk(
    int chunk, std::span<const std::byte> bytes) const {
  const bool multi_part = picture().context->is_multi_part();
  const std::size_t leader = ExrChunkTable::leader_size(*picture().context);
  const ExrPart& part = picture().part;
  if (bytes.size() < leader) return damaged(chunk, "are cut off");
  const std::byte* at = bytes.data();
  if (multi_part && read_i32(at) != part.index) return damaged(chunk, "belong to another part");
  const std::int32_t line = read_i32(at + leader - 8);
  const std::int32_t size = read_i32(at + leader - 4);
  if (line != part.data.y_begin + chunk * part.chunk_rows) {
    return damaged(chunk, "are not where the table of chunks says");
  }
  if (size <= 0 || static_cast<std::size_t>(size) > expanded_size(chunk)) {
    return damaged(chunk, "have an impossible size of " + std::to_string(size) + " bytes");
  }
  if (static_cast<std::size_t>(size) > bytes.size() - leader) return damaged(chunk, "are cut off");
  return bytes.subspan(leader, static_cast<std::size_t>(size));
}

// Chunks that are stored as they are need not be copied together if their lines lie at equal
// distances: one chunk, or lines one by one in order, upwards or downwards.
std::optional<ExrScanlineReader::Lines> ExrScanlineReader::lines_as_fetched(
    const ExrBand& band) const {
  for (int chunk = band.chunk_begin; chunk < band.chunk_end; ++chunk) {
    if (packed_[chunk - band.chunk_begin].size() != expanded_size(chunk)) return std::nullopt;
  }
  if (packed_.size() == 1) {
    return Lines{packed_[0].data(), static_cast<std::ptrdiff_t>(line_bytes_)};
  }
  if (layout().chunk_rows != 1) return std::nullopt;
  const std::ptrdiff_t stride = packed_[1].data() - packed_[0].data();
  for (std::size_t i = 2; i < packed_.size(); ++i) {
    if (packed_[i].data() - packed_[i - 1].data() != stride) return std::nullopt;
  }
  return Lines{packed_[0].data(), stride};
}

Result<ExrScanlineReader::Lines> ExrScanlineReader::expand(const ExrBand& band) {
  expanded_.resize_uninitialised(line_bytes_ * static_cast<std::size_t>(layout().rows_per_band()));
  chunks_.clear();
  std::size_t filled = 0;
  for (int chunk = band.chunk_begin; chunk < band.chunk_end; ++chunk) {
    const ExrChunkShape shape{types_, static_cast<std::size_t>(layout().data_width),
                              static_cast<std::size_t>(layout().rows_of_chunk(chunk))};
    chunks_.push_back({packed_[chunk - band.chunk_begin], shape,
                       expanded_.span().subspan(filled, expanded_size(chunk))});
    filled += expanded_size(chunk);
  }
  const std::size_t broken = inflater_.expand(chunks_);
  if (broken != chunks_.size()) {
    return damaged(band.chunk_begin + static_cast<int>(broken),
                   "do not decompress (" + exr_compression_name(picture().part.compression) + ")");
  }
  return Lines{expanded_.data(), static_cast<std::ptrdiff_t>(line_bytes_)};
}

void ExrScanlineReader::show(const ExrBand& band, const Lines& lines, RowBand& rows) {
  const int top = layout().row_of_chunk(band.chunk_begin);
  const std::byte* first = lines.first + (band.row_begin - top) * lines.stride;
  for (int c = 0; c < rows.channel_count; ++c) {
    const auto bytes = static_cast<std::ptrdiff_t>(sample_size(rows.channels[c].type));
    const std::byte* line = first + in_line_[c];
    if (!widened_) {
      rows.channels[c].data = line - layout().data_x * bytes;
      rows.channels[c].row_stride = lines.stride;
      continue;
    }
    for (int row = band.row_begin; row < band.row_end; ++row, line += lines.stride) {
      std::memcpy(widened_->sample(c, row - top), line,
                  static_cast<std::size_t>(layout().data_width * bytes));
    }
  }
  if (widened_) widened_->show(band, rows);
}

std::size_t ExrScanlineReader::expanded_size(int chunk) const {
  return line_bytes_ * static_cast<std::size_t>(layout().rows_of_chunk(chunk));
}

Error ExrScanlineReader::damaged(int chunk, const std::string& what) const {
  const int row = layout().row_of_chunk(chunk);
  const int last = row + layout().rows_of_chunk(chunk) - 1;
  const std::string which = last == row ? "the pixels of this row "
                                        : "the pixels of rows " + std::to_string(row) + " to " +
                                              std::to_string(last) + " ";
  return {ErrorCode::malformed, which + what, picture().where(row),
          "the file is damaged; copy it again"};
}

}  // namespace shoal
