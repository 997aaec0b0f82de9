// What the store holds of a whole run: its outputs, the manifest's globs and tags, short facts.
#include <string>

#include "batch/store_connection.h"
#include "batch/store_outputs.h"
#include "core/content_hash.h"

namespace shoal {
namespace {

// The properties that tell which tags and frames stand in the store.
constexpr std::string_view kFramesProperty = "frames_hash";
constexpr std::string_view kTagsProperty = "tags_hash";

constexpr const char* kSelectRunOutputs =
    "SELECT item, path, kind, content_hash, size FROM outputs WHERE item IS NULL ORDER BY rowid";

// A text with its length, so that no two lists hash the same.
void update(ContentHasher& hasher, std::string_view text) {
  hasher.update(std::to_string(text.size()) + ":");
  hasher.update(text);
}

std::string hash_of(std::span<const PanoramaTags> panoramas) {
  ContentHasher hasher;
  for (const PanoramaTags& panorama : panoramas) {
    if (panorama.tags.empty()) continue;
    update(hasher, panorama.panorama);
    for (const std::string& tag : panorama.tags) update(hasher, tag);
    hasher.update("\n");
  }
  return hasher.digest();
}

std::string hash_of(std::span<const VariantFrame> frames) {
  ContentHasher hasher;
  for (const VariantFrame& frame : frames) {
    update(hasher, frame.panorama);
    update(hasher, frame.variant);
    update(hasher, frame.frame);
  }
  return hasher.digest();
}

std::string hash_of(const GlobExpansion& glob) {
  ContentHasher hasher;
  const std::string_view end("\0", 1);  // the one byte that no path holds
  hasher.update(glob.pattern);
  for (const auto& file : glob.files) {
    hasher.update(end);
    hasher.update(file);
  }
  return hasher.digest();
}

Status replace_glob(StoreConnection& store, std::int64_t position, const GlobExpansion& glob) {
  const std::string hash = hash_of(glob);
  std::string known;
  SHOAL_RETURN_IF_ERROR(store.query(
      "SELECT files_hash FROM globs WHERE position = ?",
      [&](const SqlStatement& row) { known = row.text(0); }, position));
  if (known == hash) return {};
  SHOAL_RETURN_IF_ERROR(store.run("DELETE FROM globs WHERE position = ?", position));
  SHOAL_RETURN_IF_ERROR(
      store.run("INSERT INTO globs VALUES (?,?,?)", position, glob.pattern, hash));
  std::int64_t file_position = 0;
  for (const auto& file : glob.files) {
    SHOAL_RETURN_IF_ERROR(
        store.run("INSERT INTO glob_files VALUES (?,?,?)", position, file_position++, file));
  }
  return {};
}

}  // namespace

Status Store::set_run_outputs(std::span<const OutputRecord> outputs) {
  return impl_->write([&]() -> Status {
    SHOAL_RETURN_IF_ERROR(impl_->run("DELETE FROM outputs WHERE item IS NULL"));
    for (const OutputRecord& output : outputs) {
      SHOAL_RETURN_IF_ERROR(impl_->run(kInsertOutput, nullptr, output.path, output.kind,
                                       output.content_hash,
                                       static_cast<std::int64_t>(output.size)));
    }
    return {};
  });
}

Result<std::vector<OutputRecord>> Store::run_outputs() {
  std::vector<OutputRecord> outputs;
  SHOAL_RETURN_IF_ERROR(impl_->query(
      kSelectRunOutputs, [&](const SqlStatement& row) { outputs.push_back(read_output(row)); }));
  return outputs;
}

Status Store::set_globs(std::span<const GlobExpansion> globs) {
  return impl_->write([&]() -> Status {
    std::int64_t position = 0;
    for (const GlobExpansion& glob : globs) {
      SHOAL_RETURN_IF_ERROR(replace_glob(*impl_, position++, glob));
    }
    return impl_->run("DELETE FROM globs WHERE position >= ?", position);
  });
}

Result<std::vector<GlobExpansion>> Store::globs() {
  std::vector<GlobExpansion> globs;
  SHOAL_RETURN_IF_ERROR(
      impl_->query("SELECT pattern FROM globs ORDER BY position", [&](const SqlStatement& row) {
        globs.push_back({row.text(0), {}});
      }));
  SHOAL_RETURN_IF_ERROR(impl_->query("SELECT glob, path FROM glob_files ORDER BY glob, position",
                                     [&](const SqlStatement& row) {
                                       const auto glob = static_cast<std::size_t>(row.integer(0));
                                       if (glob < globs.size())
                                         globs[glob].files.push_back(row.text(1));
                                     }));
  return globs;
}

Status Store::replace_facts(std::string_view hash_property, const std::string& hash,
                            const std::function<Status()>& replace) {
  SHOAL_ASSIGN_OR_RETURN(known, property(hash_property));
  if (known == hash) return {};
  SHOAL_RETURN_IF_ERROR(impl_->write(replace));
  return set_property(hash_property, hash);
}

Status Store::set_tags(std::span<const PanoramaTags> panoramas) {
  return replace_facts(kTagsProperty, hash_of(panoramas), [&]() -> Status {
    SHOAL_RETURN_IF_ERROR(impl_->run("DELETE FROM tags"));
    for (const PanoramaTags& panorama : panoramas) {
      std::int64_t position = 0;
      for (const std::string& tag : panorama.tags) {
        SHOAL_RETURN_IF_ERROR(
            impl_->run("INSERT INTO tags VALUES (?,?,?)", panorama.panorama, position++, tag));
      }
    }
    return {};
  });
}

Result<std::vector<std::string>> Store::tags_of(std::string_view panorama) {
  std::vector<std::string> tags;
  SHOAL_RETURN_IF_ERROR(impl_->query(
      "SELECT tag FROM tags WHERE panorama = ? ORDER BY position",
      [&](const SqlStatement& row) { tags.push_back(row.text(0)); }, panorama));
  return tags;
}

Status Store::set_frames(std::span<const VariantFrame> frames) {
  return replace_facts(kFramesProperty, hash_of(frames), [&]() -> Status {
    SHOAL_RETURN_IF_ERROR(impl_->run("DELETE FROM frames"));
    for (const VariantFrame& frame : frames) {
      SHOAL_RETURN_IF_ERROR(impl_->run("INSERT INTO frames VALUES (?,?,?)", frame.panorama,
                                       frame.variant, frame.frame));
    }
    return {};
  });
}

Result<std::string> Store::frame_of(std::string_view panorama, std::string_view variant) {
  std::string frame;
  SHOAL_RETURN_IF_ERROR(impl_->query(
      "SELECT frame FROM frames WHERE panorama = ? AND variant = ?",
      [&](const SqlStatement& row) { frame = row.text(0); }, panorama, variant));
  return frame;
}

Status Store::set_property(std::string_view name, std::string_view value) {
  return impl_->write(
      [&] { return impl_->run("INSERT OR REPLACE INTO properties VALUES (?,?)", name, value); });
}

Result<std::string> Store::property(std::string_view name) {
  std::string value;
  SHOAL_RETURN_IF_ERROR(impl_->query(
      "SELECT value FROM properties WHERE name = ?",
      [&](const SqlStatement& row) { value = row.text(0); }, name));
  return value;
}

}  // namespace shoal
