#include "image/radiance_window.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "image/radiance_rle.h"

namespace shoal {
namespace {

// Room for a piece and the rest of its last scanline at once: a scanline that a window's end cuts
// is expanded twice. No more of it is touched than is read.
constexpr std::size_t kWindowBytes = std::size_t{1} << 19;
constexpr std::uint64_t kBeyondLimit = std::uint64_t{1} << 14;

}  // namespace

void RadianceWindow::move_to(std::uint64_t offset) {
  if (offset == this->offset()) return;
  begin_ = end_ = 0;
  next_offset_ = offset;
}

// What is left moves to the front.
void RadianceWindow::make_room(std::size_t room) {
  const std::size_t left = end_ - begin_;
  if (buffer_.size() < room + kRadianceSlack) {
    AlignedBuffer<std::uint8_t> larger;
    larger.resize_uninitialised(room + kRadianceSlack);
    if (left > 0) std::memcpy(larger.data(), buffer_.data() + begin_, left);
    buffer_ = std::move(larger);
  } else if (left > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, left);
  }
  begin_ = 0;
  end_ = left;
}

Result<std::size_t> RadianceWindow::extend() {
  const std::uint64_t unread = file_.size() - std::min(file_.size(), next_offset_);
  if (unread == 0) return std::size_t{0};
  const std::size_t left = end_ - begin_;
  const std::size_t room = std::max(kWindowBytes, 2 * left);
  const std::uint64_t until_limit = limit_ - std::min(limit_, next_offset_);
  const std::size_t wanted =
      std::min<std::uint64_t>({unread, room - left, std::max(until_limit, kBeyondLimit)});
  make_room(room);
  SHOAL_ASSIGN_OR_RETURN(got, file_.read_some(next_offset_, std::as_writable_bytes(std::span(
                                                                buffer_.data() + left, wanted))));
  next_offset_ += got;
  end_ += got;
  return got;
}

}  // namespace shoal
