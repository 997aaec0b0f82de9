#include "image/radiance_pieces.h"

#include <algorithm>

namespace shoal {
namespace {

// ceil(a / b) for a >= 0, b >= 1.
int divided_up(std::uint64_t a, std::uint64_t b) {
  return static_cast<int>(a / b + (a % b == 0 ? 0 : 1));
}

}  // namespace

// Every piece either goes on to its border or has as many scanlines as it may. The former are as
// many as there are borders, the latter at most the second term.
RadiancePieces::RadiancePieces(const PieceDivision& division)
    : division_(division),
      count_(divided_up(division.end - division.begin, division.piece_bytes) - 1 +
             divided_up(division.scanline_count, division.max_scanlines)),
      starts_{{division.begin, 0}} {}

std::uint64_t RadiancePieces::border(int piece) const {
  const std::uint64_t all = division_.end - division_.begin;
  const auto index = static_cast<std::uint64_t>(piece);
  if (index >= all / division_.piece_bytes + 1) return division_.end;
  return std::min(division_.begin + index * division_.piece_bytes, division_.end);
}

int RadiancePieces::picture_scanlines(const PieceStart& start, const PieceRun& run) const {
  return std::min(run.scanline_count, division_.scanline_count - start.scanline);
}

RadiancePieces::Claim::Claim(RadiancePieces& pieces, int piece) : pieces_(pieces), piece_(piece) {
  const std::scoped_lock lock(pieces_.mutex_);
  ++pieces_.claims_[piece_];
}

RadiancePieces::Claim::~Claim() {
  const std::scoped_lock lock(pieces_.mutex_);
  const auto entry = pieces_.claims_.find(piece_);
  if (--entry->second == 0) pieces_.claims_.erase(entry);
  pieces_.changed_.notify_all();
}

std::optional<PieceStart> RadiancePieces::start(int piece) const {
  const std::scoped_lock lock(mutex_);
  if (piece >= static_cast<int>(starts_.size())) return std::nullopt;
  return starts_[piece];
}

void RadiancePieces::tell(int piece, const PieceRun& run) {
  const std::scoped_lock lock(mutex_);
  if (piece + 1 < static_cast<int>(starts_.size())) return;  // another one has, meanwhile
  runs_[piece] = run;
  prove();
}

void RadiancePieces::prove() {
  for (;;) {
    const int last = static_cast<int>(starts_.size()) - 1;
    const auto entry = runs_.find(last);
    if (entry == runs_.end() || broken_) return;
    const PieceStart start = starts_.back();
    const PieceRun run = entry->second;
    runs_.erase(entry);
    changed_.notify_all();
    if (run.begin != start.offset) return;
    const int next = start.scanline + picture_scanlines(start, run);
    if (run.fault != nullptr && next < division_.scanline_count) {
      broken_ = BrokenScanline{next, run.fault};
      return;
    }
    starts_.push_back({run.end, next});
  }
}

RadiancePieces::Knowledge RadiancePieces::wait_for_start(int piece) {
  std::unique_lock lock(mutex_);
  for (;;) {
    const int last = static_cast<int>(starts_.size()) - 1;
    if (piece <= last) return {starts_[piece], std::nullopt, 0};
    if (broken_) return {std::nullopt, broken_, 0};
    if (!claims_.contains(last)) return {std::nullopt, std::nullopt, last};
    changed_.wait(lock);
  }
}

}  // namespace shoal
