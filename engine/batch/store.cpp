#include "batch/store.h"

#include <chrono>
#include <utility>

#include "batch/sqlite.h"
#include "batch/store_projection.h"
#include "batch/store_schema.h"
#include "core/content_hash.h"

namespace shoal {
namespace {

using Clock = std::chrono::steady_clock;
using Step = SqlStatement::Step;

constexpr auto kCommitInterval = std::chrono::seconds(1);

constexpr const char* kUpsertItem =
    "INSERT INTO items (name, status, error, input_path, input_hash, parameters, output_hash,"
    " algorithm_version, engine_version, decode_seconds, project_seconds, write_seconds,"
    " finished_at)"
    " VALUES (?,?,?,?,?,?,?,?,?,?,?,?, strftime('%Y-%m-%dT%H:%M:%fZ', 'now'))"
    " ON CONFLICT (name) DO UPDATE SET status = excluded.status, error = excluded.error,"
    " input_path = excluded.input_path, input_hash = excluded.input_hash,"
    " parameters = excluded.parameters, output_hash = excluded.output_hash,"
    " algorithm_version = excluded.algorithm_version, engine_version = excluded.engine_version,"
    " decode_seconds = excluded.decode_seconds, project_seconds = excluded.project_seconds,"
    " write_seconds = excluded.write_seconds, finished_at = excluded.finished_at"
    " RETURNING id";

// The order of columns that read_item() and read_output() go by.
constexpr const char* kSelectItems =
    "SELECT id, name, status, error, input_path, input_hash, parameters, output_hash,"
    " algorithm_version FROM items";
constexpr const char* kSelectItem =
    "SELECT id, name, status, error, input_path, input_hash, parameters, output_hash,"
    " algorithm_version FROM items WHERE name = ?";
constexpr const char* kSelectOutputs =
    "SELECT item, path, kind, content_hash, size FROM outputs WHERE item IS NOT NULL"
    " ORDER BY rowid";
constexpr const char* kSelectOutputsOfItem =
    "SELECT item, path, kind, content_hash, size FROM outputs WHERE item = ? ORDER BY rowid";
constexpr const char* kSelectRunOutputs =
    "SELECT item, path, kind, content_hash, size FROM outputs WHERE item IS NULL ORDER BY rowid";
constexpr const char* kInsertOutput =
    "INSERT OR REPLACE INTO outputs (item, path, kind, content_hash, size) VALUES (?,?,?,?,?)";

std::string_view name_of(ItemStatus status) {
  switch (status) {
    case ItemStatus::done:
      return "done";
    case ItemStatus::failed:
      return "failed";
    case ItemStatus::stale:
      return "stale";
  }
  return "";
}

// Anything unknown is processed again.
ItemStatus status_named(std::string_view name) {
  if (name == "done") return ItemStatus::done;
  return name == "failed" ? ItemStatus::failed : ItemStatus::stale;
}

ItemState read_item(const SqlStatement& row) {
  ItemState item;
  item.status = status_named(row.text(2));
  item.error = row.text(3);
  item.input_path = row.text(4);
  item.input_hash = row.text(5);
  item.parameters = row.text(6);
  item.output_hash = row.text(7);
  item.algorithm_version = static_cast<int>(row.integer(8));
  return item;
}

OutputRecord read_output(const SqlStatement& row) {
  return {row.text(1), row.text(2), row.text(3), static_cast<std::uint64_t>(row.integer(4))};
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

Error not_ours(const std::filesystem::path& path) {
  return Error{ErrorCode::malformed, "is not a store of shoal", path.string(),
               "move it away, or choose another output folder"};
}

Error no_store(const std::filesystem::path& path) {
  return Error{ErrorCode::not_found, "there is no store", path.string(),
               "`shoal run` makes it in the manifest's output folder"};
}

// What a run leaves that is killed before its first transaction: a database without anything.
Result<bool> is_empty(SqlDatabase& database) {
  SHOAL_ASSIGN_OR_RETURN(id, database.integer_of("PRAGMA application_id"));
  SHOAL_ASSIGN_OR_RETURN(tables, database.integer_of("SELECT count(*) FROM sqlite_master"));
  return id == 0 && tables == 0;
}

Status check_version(SqlDatabase& database, const std::filesystem::path& path) {
  SHOAL_ASSIGN_OR_RETURN(id, database.integer_of("PRAGMA application_id"));
  if (id != kStoreApplicationId) return not_ours(path);
  SHOAL_ASSIGN_OR_RETURN(version, database.integer_of("PRAGMA user_version"));
  if (version == kStoreVersion) return {};
  return Error{ErrorCode::unsupported,
               "the store has version " + std::to_string(version) + ", this shoal knows version " +
                   std::to_string(kStoreVersion),
               path.string(), "use the shoal that wrote it, or choose another output folder"};
}

// In one transaction, so that a kill leaves an empty database or a whole schema.
Status make_schema(SqlDatabase& database, const std::filesystem::path& path) {
  SHOAL_RETURN_IF_ERROR(database.execute("BEGIN IMMEDIATE"));
  // Another process may have been here first.
  SHOAL_ASSIGN_OR_RETURN(id, database.integer_of("PRAGMA application_id"));
  if (id == kStoreApplicationId) return database.execute("COMMIT");
  SHOAL_ASSIGN_OR_RETURN(empty, is_empty(database));
  if (!empty) return not_ours(path);
  SHOAL_RETURN_IF_ERROR(database.execute(kStoreSchema));
  const std::string marks = "PRAGMA application_id = " + std::to_string(kStoreApplicationId) +
                            "; PRAGMA user_version = " + std::to_string(kStoreVersion) + "; COMMIT";
  return database.execute(marks.c_str());
}

Status prepare_folder(const std::filesystem::path& path) {
  std::error_code code;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), code);
  if (!code) return {};
  return Error{ErrorCode::write_failed, "the output folder cannot be made: " + code.message(),
               path.parent_path().string(), "check the permissions of the folders above it"};
}

}  // namespace

struct Store::Impl {
  explicit Impl(SqlDatabase opened) : database(std::move(opened)) {}

  ~Impl() { static_cast<void>(commit()); }  // whoever wants to hear of errors calls flush()

  // Prepared once; `sql` is one of the constants, and told apart by its address.
  Result<SqlStatement*> statement(const char* sql) {
    const auto found = statements.find(sql);
    if (found != statements.end()) return &found->second;
    SHOAL_ASSIGN_OR_RETURN(prepared, database.prepare(sql));
    return &statements.emplace(sql, std::move(prepared)).first->second;
  }

  template <typename... Values>
  Status run(const char* sql, const Values&... values) {
    SHOAL_ASSIGN_OR_RETURN(prepared, statement(sql));
    return prepared->run(values...);
  }

  // Calls `take` with every row.
  template <typename Take, typename... Values>
  Status query(const char* sql, Take take, const Values&... values) {
    SHOAL_ASSIGN_OR_RETURN(prepared, statement(sql));
    prepared->start(values...);
    Result<Step> step = prepared->step();
    for (; step && *step == Step::row; step = prepared->step()) take(*prepared);
    prepared->reset();
    return step ? Status() : Status(step.error());
  }

  // All that `work` writes, or nothing of it, in the current transaction.
  template <typename Work>
  Status write(Work work) {
    if (!database.in_transaction()) SHOAL_RETURN_IF_ERROR(run("BEGIN IMMEDIATE"));
    SHOAL_RETURN_IF_ERROR(run("SAVEPOINT whole"));
    if (Status status = work(); !status) {
      // Fails only where SQLite has rolled everything back by itself, a full disk for one.
      static_cast<void>(run("ROLLBACK TO whole"));
      static_cast<void>(run("RELEASE whole"));
      return status;
    }
    SHOAL_RETURN_IF_ERROR(run("RELEASE whole"));
    return Clock::now() - last_commit < kCommitInterval ? Status() : commit();
  }

  Status commit() {
    last_commit = Clock::now();
    return database.in_transaction() ? run("COMMIT") : Status();
  }

  Status replace_item(const ItemRecord& item) {
    const ItemState& state = item.state;
    std::int64_t id = 0;
    SHOAL_RETURN_IF_ERROR(query(
        kUpsertItem, [&](const SqlStatement& row) { id = row.integer(0); }, item.name,
        name_of(state.status), state.error, state.input_path, state.input_hash, state.parameters,
        state.output_hash, state.algorithm_version, item.engine_version,
        item.timings.decode_seconds, item.timings.project_seconds, item.timings.write_seconds));
    SHOAL_RETURN_IF_ERROR(run("DELETE FROM outputs WHERE item = ?", id));
    for (const OutputRecord& output : state.outputs) {
      SHOAL_RETURN_IF_ERROR(run(kInsertOutput, id, output.path, output.kind, output.content_hash,
                                static_cast<std::int64_t>(output.size)));
    }
    SHOAL_RETURN_IF_ERROR(run("DELETE FROM projections WHERE item = ?", id));
    if (!item.projection) return {};
    SHOAL_ASSIGN_OR_RETURN(insert, statement(kInsertProjection));
    return write_projection(*insert, id, *item.projection);
  }

  Status replace_glob(std::int64_t position, const GlobExpansion& glob) {
    const std::string hash = hash_of(glob);
    std::string known;
    SHOAL_RETURN_IF_ERROR(query(
        "SELECT files_hash FROM globs WHERE position = ?",
        [&](const SqlStatement& row) { known = row.text(0); }, position));
    if (known == hash) return {};
    SHOAL_RETURN_IF_ERROR(run("DELETE FROM globs WHERE position = ?", position));
    SHOAL_RETURN_IF_ERROR(run("INSERT INTO globs VALUES (?,?,?)", position, glob.pattern, hash));
    std::int64_t file_position = 0;
    for (const auto& file : glob.files) {
      SHOAL_RETURN_IF_ERROR(
          run("INSERT INTO glob_files VALUES (?,?,?)", position, file_position++, file));
    }
    return {};
  }

  SqlDatabase database;
  std::unordered_map<const char*, SqlStatement> statements;
  Clock::time_point last_commit = Clock::now();
};

Store::Store(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;
Store::~Store() = default;

Result<Store> Store::open(const std::filesystem::path& path, Access access) {
  std::error_code ignored;
  if (access == Access::write) {
    SHOAL_RETURN_IF_ERROR(prepare_folder(path));
  } else if (!std::filesystem::exists(path, ignored)) {
    return no_store(path);
  }
  const auto create =
      access == Access::write ? SqlDatabase::Create::when_missing : SqlDatabase::Create::never;
  SHOAL_ASSIGN_OR_RETURN(database, SqlDatabase::open(path, create));
  SHOAL_RETURN_IF_ERROR(database.execute("PRAGMA foreign_keys = ON; PRAGMA cache_size = -32768"));
  if (access == Access::write) {
    SHOAL_ASSIGN_OR_RETURN(id, database.integer_of("PRAGMA application_id"));
    if (id == 0) SHOAL_RETURN_IF_ERROR(make_schema(database, path));
  } else {
    SHOAL_RETURN_IF_ERROR(database.execute("PRAGMA query_only = ON"));
    SHOAL_ASSIGN_OR_RETURN(empty, is_empty(database));
    if (empty) return no_store(path);
  }
  SHOAL_RETURN_IF_ERROR(check_version(database, path));
  return Store(std::make_unique<Impl>(std::move(database)));
}

Result<std::unordered_map<std::string, ItemState>> Store::items() {
  std::unordered_map<std::string, ItemState> items;
  std::unordered_map<std::int64_t, ItemState*> by_id;
  SHOAL_RETURN_IF_ERROR(impl_->query(kSelectItems, [&](const SqlStatement& row) {
    ItemState& item = items[row.text(1)] = read_item(row);
    by_id[row.integer(0)] = &item;
  }));
  SHOAL_RETURN_IF_ERROR(impl_->query(kSelectOutputs, [&](const SqlStatement& row) {
    const auto item = by_id.find(row.integer(0));
    if (item != by_id.end()) item->second->outputs.push_back(read_output(row));
  }));
  return items;
}

Result<std::unordered_map<std::string, InputState>> Store::inputs() {
  std::unordered_map<std::string, InputState> inputs;
  SHOAL_RETURN_IF_ERROR(impl_->query(
      "SELECT path, size, mtime_ns, content_hash FROM inputs", [&](const SqlStatement& row) {
        inputs[row.text(0)] = {static_cast<std::uint64_t>(row.integer(1)), row.integer(2),
                               row.text(3)};
      }));
  return inputs;
}

Result<std::optional<ItemState>> Store::find_item(std::string_view name) {
  std::optional<ItemState> item;
  std::int64_t id = 0;
  SHOAL_RETURN_IF_ERROR(impl_->query(
      kSelectItem,
      [&](const SqlStatement& row) {
        id = row.integer(0);
        item = read_item(row);
      },
      name));
  if (!item) return item;
  SHOAL_RETURN_IF_ERROR(impl_->query(
      kSelectOutputsOfItem,
      [&](const SqlStatement& row) { item->outputs.push_back(read_output(row)); }, id));
  return item;
}

Result<std::optional<Projection>> Store::find_projection(std::string_view name) {
  Result<std::optional<Projection>> found = std::optional<Projection>();
  SHOAL_RETURN_IF_ERROR(impl_->query(
      kSelectProjection,
      [&](const SqlStatement& row) {
        auto projection = read_projection(row);
        if (projection) {
          found = std::optional<Projection>(std::move(*projection));
        } else {
          found = std::move(projection).error();
          found.error().where = name;
        }
      },
      name));
  return found;
}

Status Store::record_input(std::string_view path, const InputState& state) {
  return impl_->write([&] {
    return impl_->run("INSERT OR REPLACE INTO inputs VALUES (?,?,?,?)", path,
                      static_cast<std::int64_t>(state.size), state.mtime_ns, state.content_hash);
  });
}

Status Store::mark_stale(std::span<const std::string> names) {
  if (names.empty()) return {};
  const auto mark = [&]() -> Status {
    for (const auto& name : names) {
      SHOAL_RETURN_IF_ERROR(impl_->run("UPDATE items SET status = 'stale' WHERE name = ?", name));
    }
    return {};
  };
  SHOAL_RETURN_IF_ERROR(impl_->write(mark));
  return flush();
}

Status Store::forget_others(std::span<const std::string> names) {
  return impl_->write([&]() -> Status {
    SHOAL_RETURN_IF_ERROR(
        impl_->run("CREATE TEMP TABLE IF NOT EXISTS kept (name TEXT PRIMARY KEY) WITHOUT ROWID"));
    SHOAL_RETURN_IF_ERROR(impl_->run("DELETE FROM kept"));
    for (const auto& name : names) {
      SHOAL_RETURN_IF_ERROR(impl_->run("INSERT OR IGNORE INTO kept VALUES (?)", name));
    }
    return impl_->run("DELETE FROM items WHERE name NOT IN (SELECT name FROM kept)");
  });
}

Status Store::record(const ItemRecord& item) {
  return impl_->write([&] { return impl_->replace_item(item); });
}

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
      SHOAL_RETURN_IF_ERROR(impl_->replace_glob(position++, glob));
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

Status Store::flush() { return impl_->commit(); }

}  // namespace shoal
