// What a killed run leaves behind: files under temporary names. The next run clears them away.
//
// While a run writes to an output folder, the store bears a mark and the folder a shared lock. The
// mark outlives a kill, the lock does not: where there is a mark and nobody holds the lock, the
// temporary files are nobody's. Only then is the folder walked, so a library of any size costs
// nothing otherwise. Where the file system has no such locks, leftovers stay.
#pragma once

#include <filesystem>

#include "batch/store.h"
#include "core/result.h"

namespace shoal {

// Removes files with temporary names from the places that runs write to: `folder` itself, and
// maps/ and exports/ below it with all of their folders. Returns how many.
int remove_leftovers(const std::filesystem::path& folder);

class RunMark {
 public:
  RunMark(RunMark&& other) noexcept;
  RunMark& operator=(RunMark&& other) noexcept;
  ~RunMark();  // gives the lock back; the mark stays unless clear() was called

  // Clears up after a killed run, then marks `folder`, which is the store's. Errors: the store's.
  static Result<RunMark> set(const std::filesystem::path& folder, Store& store);

  // The run has ended by itself.
  Status clear(Store& store);

 private:
  RunMark() = default;

  int descriptor_ = -1;  // of the folder, for its lock
};

}  // namespace shoal
