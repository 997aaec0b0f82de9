#include "image/radiance_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace shoal {
namespace {

// How many markers that turn out to be none are worth a try; expanding a scanline is what one
// costs. In pictures there are next to none, in hostile files as many as anybody likes.
constexpr int kMaxGuesses = 8;

// Where the first marker begins; if there is none, where one begins at the earliest that more bytes
// may complete. (Without an exit inside a block, so that the compiler makes vectors of it.)
std::size_t find_marker(std::span<const std::uint8_t> bytes,
                        const std::array<std::uint8_t, 4>& marker) {
  if (bytes.size() < marker.size()) return 0;
  constexpr std::size_t kBlock = 256;
  const std::size_t count = bytes.size() - (marker.size() - 1);
  const std::uint8_t* at = bytes.data();
  const auto begins_at = [&](std::size_t i) {
    return static_cast<std::uint8_t>(at[i] == marker[0]) & (at[i + 1] == marker[1]) &
           (at[i + 2] == marker[2]) & (at[i + 3] == marker[3]);
  };
  for (std::size_t block = 0; block < count; block += kBlock) {
    const std::size_t end = std::min(block + kBlock, count);
    std::uint8_t found = 0;
    for (std::size_t i = block; i < end; ++i) found |= begins_at(i);
    if (found == 0) continue;
    for (std::size_t i = block; i < end; ++i) {
      if (begins_at(i) != 0) return i;
    }
  }
  return count;
}

}  // namespace

RadianceReader::RadianceReader(std::shared_ptr<const RadianceFile> picture)
    : picture_(std::move(picture)),
      pieces_(*picture_->pieces),
      window_(picture_->file, picture_->header.data_offset) {
  const auto width = static_cast<std::size_t>(picture_->header.scanline_width);
  stride_ = (width + kAlignment - 1) / kAlignment * kAlignment + kRadianceSlack;
}

Result<RowBand> RadianceReader::read(int index) {
  const auto rows = static_cast<std::size_t>(pieces_.division().max_scanlines) + 1;
  for (auto& plane : planes_) plane.resize_uninitialised(rows * stride_);
  const RadiancePieces::Claim claim(pieces_, index);
  std::optional<PieceRun> run;
  std::optional<PieceStart> start = pieces_.start(index);
  if (!start) {
    SHOAL_ASSIGN_OR_RETURN(ahead, run_ahead(index));
    if (ahead) pieces_.tell(index, *ahead);
    run = ahead;
    SHOAL_ASSIGN_OR_RETURN(proven, await_start(index));
    start = proven;
  }
  if (!run || run->begin != start->offset) {
    SHOAL_ASSIGN_OR_RETURN(from_start, run_from(index, *start, expand_radiance_scanline));
    pieces_.tell(index, from_start);
    run = from_start;
  }
  const int end = start->scanline + pieces_.picture_scanlines(*start, *run);
  if (run->fault != nullptr && end < pieces_.division().scanline_count) {
    return failure({end, run->fault});
  }
  return band(start->scanline, end);
}

// Goes through `piece` from a guess on; nothing if there is none.
Result<std::optional<PieceRun>> RadianceReader::run_ahead(int piece) {
  const std::uint64_t end = pieces_.bytes_end(piece);
  std::optional<PieceRun> run;
  if (pieces_.bytes_begin(piece) >= end) return run;
  if (picture_->start_guess == StartGuess::marker) {
    SHOAL_ASSIGN_OR_RETURN(begun, begin_at_marker(piece));
    run = begun;
  } else if (picture_->start_guess == StartGuess::stride) {
    const std::uint64_t first = picture_->header.data_offset;
    const std::uint64_t stride = 4 * static_cast<std::uint64_t>(picture_->header.scanline_width);
    const std::uint64_t before = (pieces_.bytes_begin(piece) - first + stride - 1) / stride;
    const std::uint64_t begin = first + before * stride;
    if (begin >= end) return run;
    window_.move_to(begin);
    run = PieceRun{begin, begin, 0, nullptr};
  }
  if (!run) return run;
  SHOAL_RETURN_IF_ERROR(
      go_on(piece, pieces_.division().max_scanlines, expand_radiance_scanline, *run));
  return run;
}

// The first scanline of `piece` that begins with a marker and leads to another.
Result<std::optional<PieceRun>> RadianceReader::begin_at_marker(int piece) {
  const std::uint64_t end = pieces_.bytes_end(piece);
  window_.move_to(pieces_.bytes_begin(piece));
  limit_window(piece);
  for (int guess = 0; guess < kMaxGuesses; ++guess) {
    SHOAL_ASSIGN_OR_RETURN(found, seek_marker(end));
    if (!found) break;
    const std::uint64_t begin = window_.offset();
    SHOAL_ASSIGN_OR_RETURN(fault, take_scanline(0, expand_radiance_scanline));
    if (fault == nullptr) {
      SHOAL_ASSIGN_OR_RETURN(leads_on, is_at_marker_or_end());
      if (leads_on) return std::optional(PieceRun{begin, window_.offset(), 1, nullptr});
    }
    window_.move_to(begin + 1);
  }
  return std::optional<PieceRun>();
}

// Moves the window on to the next marker that begins before `end`; whether there is one.
Result<bool> RadianceReader::seek_marker(std::uint64_t end) {
  for (;;) {
    const auto bytes = window_.bytes();
    const std::size_t at = find_marker(bytes, marker());
    const bool found = at + marker().size() <= bytes.size();
    window_.consume(at);
    if (window_.offset() >= end) return false;
    if (found) return true;
    SHOAL_ASSIGN_OR_RETURN(got, window_.extend());
    if (got == 0) return false;
  }
}

Result<bool> RadianceReader::is_at_marker_or_end() {
  const auto expected = marker();
  while (window_.bytes().size() < expected.size()) {
    SHOAL_ASSIGN_OR_RETURN(got, window_.extend());
    if (got == 0) return window_.bytes().empty();
  }
  return std::ranges::equal(window_.bytes().first(expected.size()), expected);
}

// Waits for the start of `piece`, and meanwhile does what nobody else does.
Result<PieceStart> RadianceReader::await_start(int piece) {
  for (;;) {
    const auto known = pieces_.wait_for_start(piece);
    if (known.start) return *known.start;
    if (known.broken) return failure(*known.broken);
    const RadiancePieces::Claim claim(pieces_, known.missing);
    const auto start = pieces_.start(known.missing);
    SHOAL_ASSIGN_OR_RETURN(run, run_from(known.missing, *start, skip_radiance_scanline));
    pieces_.tell(known.missing, run);
  }
}

// Goes through `piece` from where it does begin.
Result<PieceRun> RadianceReader::run_from(int piece, const PieceStart& start, TakeScanline take) {
  const PieceDivision& division = pieces_.division();
  window_.move_to(start.offset);
  PieceRun run{start.offset, start.offset, 0, nullptr};
  const int most = std::min(division.max_scanlines, division.scanline_count - start.scanline);
  SHOAL_RETURN_IF_ERROR(go_on(piece, most, take, run));
  return run;
}

// Takes the scanlines of `run` behind those that it has. What begins at the file's end begins in
// the last piece too: the scanline that is missing there.
Status RadianceReader::go_on(int piece, int most, TakeScanline take, PieceRun& run) {
  const std::uint64_t end = pieces_.bytes_end(piece);
  const bool until_file_end = end == pieces_.division().end;
  limit_window(piece);
  const bool skips = take == skip_radiance_scanline;
  while (run.scanline_count < most && (until_file_end || window_.offset() < end)) {
    const int row = skips ? pieces_.division().max_scanlines : run.scanline_count;
    SHOAL_ASSIGN_OR_RETURN(fault, take_scanline(row, take));
    if (fault != nullptr) {
      run.fault = fault;
      break;
    }
    ++run.scanline_count;
  }
  run.end = window_.offset();
  return {};
}

// Nothing, or what is wrong with the scanline. One that the window's end cuts is taken again when
// more of the file is there.
Result<const char*> RadianceReader::take_scanline(int buffer_row, TakeScanline take) {
  const std::size_t offset = static_cast<std::size_t>(buffer_row) * stride_;
  const std::array<std::uint8_t*, 4> planes = {
      planes_[0].data() + offset, planes_[1].data() + offset, planes_[2].data() + offset,
      planes_[3].data() + offset};
  for (;;) {
    const auto result =
        take(window_.bytes(), picture_->header.scanline_width, picture_->data_size, planes);
    if (result.state == ScanlineState::broken) return result.fault;
    if (result.state == ScanlineState::whole) {
      window_.consume(result.bytes);
      return nullptr;
    }
    SHOAL_ASSIGN_OR_RETURN(got, window_.extend());
    if (got == 0) return "is cut off by the end of the file";
  }
}

// The last scanline of a piece ends behind it; hardly one takes more bytes than its texels.
void RadianceReader::limit_window(int piece) {
  window_.limit(pieces_.bytes_end(piece) +
                4 * static_cast<std::uint64_t>(picture_->header.scanline_width));
}

Error RadianceReader::failure(const BrokenScanline& broken) const {
  const auto& header = picture_->header;
  const int count = header.scanline_count;
  const int place = header.scanlines_reversed ? count - 1 - broken.scanline : broken.scanline;
  return Error{ErrorCode::malformed,
               fmt::format("{} {} {}; {} of {} are good",
                           header.scan_axis == ScanAxis::rows ? "row" : "column", place,
                           broken.fault, broken.scanline, count),
               fmt::format("{}:{}", picture_->file.path(), place), "copy or write the file again"};
}

// The buffers hold scanlines as the file orders them; the band ascends in the picture.
RowBand RadianceReader::band(int begin, int end) const {
  const auto& header = picture_->header;
  RowBand band;
  band.row_begin = header.scanlines_reversed ? header.scanline_count - end : begin;
  band.row_end = header.scanlines_reversed ? header.scanline_count - begin : end;
  band.width = header.scanline_width;
  band.channel_count = 3;
  for (int c = 0; c < 3; ++c) band.channels[c] = plane(planes_[c], end - begin);
  band.exponent = plane(planes_[3], end - begin);
  return band;
}

Plane RadianceReader::plane(const AlignedBuffer<std::uint8_t>& buffer, int rows) const {
  const auto* data = reinterpret_cast<const std::byte*>(buffer.data());
  const auto stride = static_cast<std::ptrdiff_t>(stride_);
  if (!picture_->header.scanlines_reversed) return {data, stride, picture_->sample_type};
  return {data + std::max(rows - 1, 0) * stride, -stride, picture_->sample_type};
}

std::array<std::uint8_t, 4> RadianceReader::marker() const {
  return new_rle_marker(picture_->header.scanline_width);
}

}  // namespace shoal
