// How the scanlines of one Radiance file are shared out to workers that read it at once.
//
// Where a scanline begins is known only to who has gone through all those before it. Going through
// them twice, once quickly to find the starts and once to expand them, was measured: the quick pass
// alone costs a seventh of the whole work, and one worker's pass is what all others wait for. So
// the file is cut by bytes instead, into pieces of equal length:
//
//   - Piece k has the scanlines that begin in its bytes, in order. Its first one is a guess, unless
//     the worker of piece k-1 has told it already; the worker expands from there on and tells where
//     it came to (a PieceRun). Where there is nothing to guess, it waits instead.
//   - A run is proven when it begins where the run before it, itself proven, has ended. That also
//     numbers its scanlines. A run that begins elsewhere began with a wrong guess, and is done
//     again from the proven start. So a file can make guesses wrong, and its workers slow, but
//     never their result.
//   - Only then the band is handed out. As workers take pieces in order, the runs before a worker's
//     own were begun before it, and it hardly waits.
//
// One worker alone never guesses and never waits. Nothing is gone through twice, but the scanline
// that each border cuts: the bytes behind the border are read for it, and looked through for the
// first start, by two workers.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

namespace shoal {

// How a file is cut. Invariant: piece_bytes, max_scanlines, scanline_count >= 1.
struct PieceDivision {
  std::uint64_t begin = 0;  // of the first scanline, in the file
  std::uint64_t end = 0;    // of the file
  std::uint64_t piece_bytes = 1;
  int scanline_count = 1;
  int max_scanlines = 1;  // of a piece, to bound memory: those too many go to the pieces after it
};

// Where a piece begins, proven.
struct PieceStart {
  std::uint64_t offset = 0;
  int scanline = 0;  // which one begins there
};

// What going through the scanlines of a piece has found.
struct PieceRun {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
  int scanline_count = 0;       // that are good
  const char* fault = nullptr;  // of the scanline behind them, if it is not
};

// The first scanline that is not good.
struct BrokenScanline {
  int scanline = 0;
  const char* fault = "";
};

// Any thread may call any function.
class RadiancePieces {
 public:
  explicit RadiancePieces(const PieceDivision& division);

  // Pieces may be empty. Behind those that the file's bytes make, there are as many as scanlines
  // too many for their pieces can need.
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] const PieceDivision& division() const { return division_; }

  // The bytes in which the scanlines of `piece` begin; empty at the file's end for the last pieces.
  [[nodiscard]] std::uint64_t bytes_begin(int piece) const { return border(piece); }
  [[nodiscard]] std::uint64_t bytes_end(int piece) const { return border(piece + 1); }

  // How many scanlines of a run that is proven to begin at `start` are the picture's. (What stands
  // behind the last one may look like scanlines too.)
  [[nodiscard]] int picture_scanlines(const PieceStart& start, const PieceRun& run) const;

  // Held while its piece is worked on.
  class Claim {
   public:
    Claim(RadiancePieces& pieces, int piece);
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;
    ~Claim();

   private:
    RadiancePieces& pieces_;
    int piece_;
  };

  // Where `piece` begins, if that is proven.
  [[nodiscard]] std::optional<PieceStart> start(int piece) const;

  // The caller has gone through `piece`. Proves what can be proven now.
  void tell(int piece, const PieceRun& run);

  // What is known about a piece's start.
  struct Knowledge {
    std::optional<PieceStart> start;       // of the piece
    std::optional<BrokenScanline> broken;  // before the piece
    int missing = 0;                       // else: a piece before it that nobody works on
  };

  // Waits until the start of `piece` is proven or cannot be, or until some piece before it must be
  // gone through and nobody is at it. The caller must have told what it knows of `piece`: others
  // may wait for that. Holding a claim on it is no obstacle.
  [[nodiscard]] Knowledge wait_for_start(int piece);

 private:
  [[nodiscard]] std::uint64_t border(int piece) const;
  void prove();

  PieceDivision division_;
  int count_ = 0;

  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::vector<PieceStart> starts_;  // of the pieces from 0 on, as far as they are proven
  std::optional<BrokenScanline> broken_;
  std::map<int, PieceRun> runs_;  // told, not yet proven
  std::map<int, int> claims_;     // how many work on a piece
};

}  // namespace shoal
