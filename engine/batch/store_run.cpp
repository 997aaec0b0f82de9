// What the store holds of a whole run: its outputs, the manifest's globs and tags, short facts.
#include <string>

#include "batch/store_connection.h"
#include "batch/store_numbers.h"
#include "batch/store_outputs.h"
#include "core/content_hash.h"

namespace shoal {
namespace {

// The properties that tell which tags and variants stand in the store.
constexpr std::string_view kVariantsProperty = "variants_hash";
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

std::string rows_of(const glm::dmat3& matrix) {
  std::vector<double> rows;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rows.push_back(matrix[column][row]);
  }
  return joined(rows);
}

// The identity where the text is not that of a matrix.
glm::dmat3 matrix_of(const std::string& text) {
  glm::dmat3 matrix(1.0);
  const std::vector<double> rows = split(text);
  for (std::size_t i = 0; rows.size() == 9 && i < 9; ++i) matrix[i % 3][i / 3] = rows[i];
  return matrix;
}

std::string hash_of(std::span<const VariantFacts> variants) {
  ContentHasher hasher;
  for (const VariantFacts& facts : variants) {
    update(hasher, facts.panorama);
    update(hasher, facts.variant);
    update(hasher, text_of(facts.frame));
    for (const glm::dmat3& matrix : {facts.colour, facts.turn}) {
      // As bytes: text would be nine conversions a matrix, in runs that find all up to date, too.
      hasher.update({reinterpret_cast<const char*>(&matrix), sizeof matrix});
    }
    update(hasher, facts.is_whole ? "whole" : "not whole");
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

Status Store::set_variants(std::span<const VariantFacts> variants) {
  return replace_facts(kVariantsProperty, hash_of(variants), [&]() -> Status {
    SHOAL_RETURN_IF_ERROR(impl_->run("DELETE FROM variants"));
    for (const VariantFacts& facts : variants) {
      SHOAL_RETURN_IF_ERROR(impl_->run("INSERT INTO variants VALUES (?,?,?,?,?,?)", facts.panorama,
                                       facts.variant, text_of(facts.frame), rows_of(facts.colour),
                                       rows_of(facts.turn), std::int64_t{facts.is_whole}));
    }
    return {};
  });
}

Result<std::vector<VariantFacts>> Store::variants() {
  std::vector<VariantFacts> variants;
  SHOAL_RETURN_IF_ERROR(impl_->query(
      "SELECT * FROM variants ORDER BY panorama, variant", [&](const SqlStatement& row) {
        const auto frame = parse_frame(row.text(2));
        variants.push_back({row.text(0), row.text(1), frame ? *frame : Frame{},
                            matrix_of(row.text(3)), matrix_of(row.text(4)), row.integer(5) != 0});
      }));
  return variants;
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
