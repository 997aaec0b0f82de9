// A part of a Radiance file in memory that moves forward over it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/aligned_buffer.h"
#include "core/input_file.h"
#include "core/result.h"

namespace shoal {

class RadianceWindow {
 public:
  // `file` must outlive the window.
  RadianceWindow(const InputFile& file, std::uint64_t offset) : file_(file), next_offset_(offset) {}

  // kRadianceSlack bytes behind them may be read too.
  [[nodiscard]] std::span<const std::uint8_t> bytes() const {
    return {buffer_.data() + begin_, end_ - begin_};
  }

  // Where bytes() begin in the file.
  [[nodiscard]] std::uint64_t offset() const { return next_offset_ - (end_ - begin_); }

  void consume(std::size_t count) { begin_ += count; }

  // Goes on from `offset`; free where the window is there already.
  void move_to(std::uint64_t offset);

  // Where reading ahead ends, because the bytes behind are for somebody else. Those that are needed
  // nevertheless come, a few at a time.
  void limit(std::uint64_t offset) { limit_ = offset; }

  // Reads on behind what is left, with more room if it is much already. Returns how many bytes
  // came; 0 at the end of the file. Errors: unreadable.
  Result<std::size_t> extend();

 private:
  void make_room(std::size_t room);

  const InputFile& file_;
  std::uint64_t next_offset_;  // of the first byte behind the window
  std::uint64_t limit_ = 0;
  AlignedBuffer<std::uint8_t> buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
};

}  // namespace shoal
