// Parts of shoal that are shared objects of their own, loaded when they are first needed: they
// bring libraries that would slow down every start.
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <vector>

#include "core/result.h"

namespace shoal {

// One such part. Its entry point is a C function without arguments that returns a pointer to a
// struct whose first member is the version of the interface, a std::uint32_t.
struct ModuleName {
  const char* file;
  const char* entry_point;
  std::uint32_t interface_version;
  const char* hint;  // what to do where it is missing
};

// Loaded by whoever is first to ask, and never unloaded: libraries keep threads of their own.
class LazyModule {
 public:
  explicit constexpr LazyModule(const ModuleName& name) : name_(name) {}

  // What the entry point returned. Errors: unsupported, with an empty `where`; tried anew then.
  Result<const void*> get();

 private:
  ModuleName name_;
  std::mutex mutex_;
  const void* module_ = nullptr;
};

// Where modules are looked for, in this order: the folders of the environment variable
// SHOAL_MODULE_PATH (separated by ':'), the executable's own folder (a build tree), and the library
// folder that an installed executable belongs to.
[[nodiscard]] std::vector<std::filesystem::path> module_search_path();

}  // namespace shoal
