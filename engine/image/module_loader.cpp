#include "image/module_loader.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>

namespace shoal {
namespace {

// dlopen's own words say what is missing when the module is there but does not load.
Error module_error(const ModuleName& name, const std::string& what) {
  return Error{ErrorCode::unsupported, what, "", name.hint};
}

Result<const void*> load(const ModuleName& name) {
  std::string tried;
  for (const auto& folder : module_search_path()) {
    const auto file = folder / name.file;
    std::error_code code;
    if (!std::filesystem::exists(file, code)) {
      tried += (tried.empty() ? "" : ", ") + folder.string();
      continue;
    }
    void* const handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!handle)
      return module_error(name, fmt::format("the module does not load: {}", ::dlerror()));
    const auto entry = reinterpret_cast<const void* (*)()>(::dlsym(handle, name.entry_point));
    const void* module = entry ? entry() : nullptr;
    if (module && *static_cast<const std::uint32_t*>(module) == name.interface_version) {
      return module;
    }
    return module_error(name, fmt::format("{} belongs to another version of shoal", file.string()));
  }
  return module_error(name,
                      fmt::format("the module {} is needed, which is not in {}", name.file, tried));
}

}  // namespace

Result<const void*> LazyModule::get() {
  const std::lock_guard lock(mutex_);
  if (!module_) {
    SHOAL_ASSIGN_OR_RETURN(loaded, load(name_));
    module_ = loaded;
  }
  return module_;
}

std::vector<std::filesystem::path> module_search_path() {
  std::vector<std::filesystem::path> folders;
  if (const char* variable = std::getenv("SHOAL_MODULE_PATH")) {
    for (std::string_view rest = variable; !rest.empty();) {
      const auto folder = rest.substr(0, rest.find(':'));
      if (!folder.empty()) folders.emplace_back(folder);
      rest.remove_prefix(std::min(rest.size(), folder.size() + 1));
    }
  }
  std::error_code code;
  const auto executable = std::filesystem::read_symlink("/proc/self/exe", code);
  if (!code) {
    folders.push_back(executable.parent_path());
    folders.push_back((executable.parent_path() / SHOAL_MODULE_FOLDER).lexically_normal());
  }
  return folders;
}

}  // namespace shoal
