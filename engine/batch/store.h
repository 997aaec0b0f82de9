// The store, shoal.db at the output folder: what was done, from what, with which result. It makes
// runs resumable and tables reproducible without decoding anything again.
//
// The tables are described in batch/store_schema.h. What is stored of a panorama is its projection;
// variants, quantities and frames are linear in that and made from it whenever a table is written.
//
// What a kill leaves behind. Writes gather in a transaction, committed by the first write that
// comes a second or more after the last commit, by flush(), and by the destructor. After a kill at
// any moment the store holds whole records only, and lacks at most what was recorded within a
// second. It stays true of the files beside it if the caller
//   1. marks the items about to run with mark_stale() before the first of their outputs is written,
//   2. calls record() for an item after the last of its outputs has got its final name,
//   3. calls set_run_outputs({}) and flush() before the first table is replaced.
//
// One thread at a time. Several processes may read; one that writes while another does waits for up
// to half a minute. The journal is SQLite's rollback journal, which network file systems bear and
// which leaves no file beside the store.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/mat3x3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/result.h"
#include "sphere/light_quality.h"
#include "transform/projector.h"

namespace shoal {

inline constexpr std::string_view kStoreFileName = "shoal.db";

// A file as it was when its content was last hashed.
struct InputState {
  std::uint64_t size = 0;
  std::int64_t mtime_ns = 0;  // since 1970
  std::string content_hash;

  friend bool operator==(const InputState&, const InputState&) = default;
};

// A file that was written.
struct OutputRecord {
  std::string path;  // relative to the store's folder
  std::string kind;  // "map:irradiance", "table:csv"
  std::string content_hash;
  std::uint64_t size = 0;

  friend bool operator==(const OutputRecord&, const OutputRecord&) = default;
};

enum class ItemStatus {
  done,
  failed,
  stale,  // its outputs may be those of another run than the one recorded: process it again
};

// What the plan needs to know of a panorama: what its last processing was a function of.
struct ItemState {
  ItemStatus status = ItemStatus::done;
  std::string error;        // of a failed one
  std::string input_path;   // empty where there is no file
  std::string input_hash;   // of the content that was processed
  std::string parameters;   // what the projection depends on besides, as the caller tells it
  std::string output_hash;  // of what its own outputs depend on besides
  int algorithm_version = 0;
  std::vector<OutputRecord> outputs;

  friend bool operator==(const ItemState&, const ItemState&) = default;
};

// The same for a pass over all items: what it points to lives until the pass goes on.
struct ItemRow {
  // A file as InputState tells it.
  struct Input {
    std::uint64_t size = 0;
    std::int64_t mtime_ns = 0;
    std::string_view content_hash;
  };

  std::int64_t id = 0;  // of the item in this store
  std::string_view name;
  ItemStatus status = ItemStatus::done;
  std::string_view error;
  std::string_view input_path;
  std::string_view input_hash;
  std::string_view parameters;
  std::string_view output_hash;
  int algorithm_version = 0;
  std::optional<Input> input;  // what is known of the file at `input_path`
};

// Seconds of work in all threads together.
struct ItemTimings {
  double decode_seconds = 0.0;
  double project_seconds = 0.0;
  double write_seconds = 0.0;
};

// Directions in the native frame.
struct VariantQuality {
  std::string variant;
  LightQuality quality;

  friend bool operator==(const VariantQuality&, const VariantQuality&) = default;
};

struct ItemRecord {
  std::string name;
  ItemState state;  // done or failed
  std::string engine_version;
  ItemTimings timings;
  const Projection* projection = nullptr;  // of one that is done
  std::vector<VariantQuality> quality;     // where it was asked for, in the variants' order
  std::optional<InputState> input;         // of its file, to be remembered as by record_input()
};

// A glob of the manifest and the files it stands for.
struct GlobExpansion {
  std::string pattern;
  std::vector<std::string> files;

  friend bool operator==(const GlobExpansion&, const GlobExpansion&) = default;
};

// What a manifest says of a panorama for people and filters: nothing that is computed depends on
// it.
struct PanoramaTags {
  std::string_view panorama;
  std::span<const std::string> tags;
};

// What a run makes of the light of a panorama's pixels in a variant, but for its window.
struct VariantFacts {
  std::string panorama;
  std::string variant;
  Frame frame;             // of the tables' rows
  glm::dmat3 colour{1.0};  // new (r, g, b) = colour * (r, g, b), linear Rec.709
  glm::dmat3 turn{1.0};    // what stood at x stands at turn * x, native frame
  bool is_whole = true;    // that is all; else light was added or taken out besides

  friend bool operator==(const VariantFacts&, const VariantFacts&) = default;
};

class Store {
 public:
  enum class Access {
    write,  // made, with its folders, when missing
    read,   // must exist; nothing is changed but for clearing up behind a killed run
  };

  // Errors: not_found (for reading; a database without anything counts as none); malformed
  // (damaged, or another program's); unsupported (a newer shoal's); unreadable, write_failed. All
  // further calls: malformed, unreadable, write_failed.
  static Result<Store> open(const std::filesystem::path& path, Access access);

  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;
  ~Store();

  // Hands over every item, then every output of an item with the item's id. In one pass each:
  // 100,000 items take 0.2 s. Nothing may be asked of the store meanwhile.
  Status for_each_item(const std::function<void(const ItemRow&)>& take);
  Status for_each_output(const std::function<void(std::int64_t item, OutputRecord)>& take);

  // All of that by panorama's name: about 1.2 kB a panorama of two outputs.
  Result<std::unordered_map<std::string, ItemState>> items();

  // One at a time; nothing where the store has none.
  Result<std::optional<InputState>> find_input(std::string_view path);
  Result<std::optional<Projection>> find_projection(std::string_view name);
  Result<std::optional<Projection>> find_projection(std::int64_t item);  // by ItemRow::id
  Result<std::vector<VariantQuality>> find_quality(std::int64_t item);

  // Does `work`, which only reads, under one lock for all of it. A lock for each thing asked takes
  // as long as finding a projection does.
  Status read_in_one(const std::function<Status()>& work);

  // Remembers what a file's content hashed to.
  Status record_input(std::string_view path, const InputState& state);

  // Marks those of the panoramas that the store knows, and commits.
  Status mark_stale(std::span<const std::string> names);

  // Forgets all panoramas but these. Their files stay where they are.
  Status forget_others(std::span<const std::string> names);

  // Takes the place of what was known of the panorama. A failed one loses projection, figures of
  // quality and outputs.
  Status record(const ItemRecord& item);

  // Outputs of the whole run: tables. They take the place of those before.
  Status set_run_outputs(std::span<const OutputRecord> outputs);
  Result<std::vector<OutputRecord>> run_outputs();

  // The globs of this run. Those that stand for the same files as before cost no writing.
  Status set_globs(std::span<const GlobExpansion> globs);
  Result<std::vector<GlobExpansion>> globs();

  // The tags of this run's panoramas take the place of those before; the same ones cost no writing.
  Status set_tags(std::span<const PanoramaTags> panoramas);
  Result<std::vector<std::string>> tags_of(std::string_view panorama);

  // Likewise for variants; those that are not named are native and have their pixels' light.
  Status set_variants(std::span<const VariantFacts> variants);
  Result<std::vector<VariantFacts>> variants();  // by panorama and variant

  // Short facts, such as a hash of what the tables were made from; empty where there is none.
  Status set_property(std::string_view name, std::string_view value);
  Result<std::string> property(std::string_view name);

  // Commits what was written since the last time.
  Status flush();

 private:
  struct Impl;
  explicit Store(std::unique_ptr<Impl> impl);
  // Calls `replace` where what it writes has another hash than what stands.
  Status replace_facts(std::string_view hash_property, const std::string& hash,
                       const std::function<Status()>& replace);
  std::unique_ptr<Impl> impl_;
};

}  // namespace shoal
