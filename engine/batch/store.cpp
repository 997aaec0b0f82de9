#include "batch/store.h"

#include <chrono>
#include <utility>

#include "batch/sqlite.h"
#include "batch/store_database.h"
#include "batch/store_projection.h"
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

// The order of columns that read_item() goes by.
constexpr const char* kSelectItems =
    "SELECT id, name, status, error, input_path, input_hash, parameters, output_hash,"
    " algorithm_version, size, mtime_ns, content_hash"
    " FROM items LEFT JOIN inputs ON inputs.path = input_path";
// The order of columns that read_output() goes by.
constexpr const char* kSelectOutputs =
    "SELECT item, path, kind, content_hash, size FROM outputs WHERE item IS NOT NULL"
    " ORDER BY rowid";
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

ItemRow read_item(const SqlStatement& row) {
  ItemRow item;
  item.id = row.integer(0);
  item.name = row.text_view(1);
  item.status = status_named(row.text_view(2));
  item.error = row.text_view(3);
  item.input_path = row.text_view(4);
  item.input_hash = row.text_view(5);
  item.parameters = row.text_view(6);
  item.output_hash = row.text_view(7);
  item.algorithm_version = static_cast<int>(row.integer(8));
  if (const auto known_hash = row.text_view(11); !known_hash.empty()) {
    item.input = {static_cast<std::uint64_t>(row.integer(9)), row.integer(10), known_hash};
  }
  return item;
}

ItemState state_of(const ItemRow& row) {
  ItemState state;
  state.status = row.status;
  state.error = row.error;
  state.input_path = row.input_path;
  state.input_hash = row.input_hash;
  state.parameters = row.parameters;
  state.output_hash = row.output_hash;
  state.algorithm_version = row.algorithm_version;
  return state;
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

  Status replace_input(std::string_view path, const InputState& state) {
    return run("INSERT OR REPLACE INTO inputs VALUES (?,?,?,?)", path,
               static_cast<std::int64_t>(state.size), state.mtime_ns, state.content_hash);
  }

  Status replace_item(const ItemRecord& item) {
    const ItemState& state = item.state;
    if (item.input) SHOAL_RETURN_IF_ERROR(replace_input(state.input_path, *item.input));
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

  template <typename Key>
  Result<std::optional<Projection>> find_projection(const char* sql, const Key& key) {
    Result<std::optional<Projection>> found = std::optional<Projection>();
    const auto take = [&](const SqlStatement& row) {
      auto projection = read_projection(row);
      if (projection) {
        found = std::optional<Projection>(std::move(*projection));
      } else {
        found = std::move(projection).error();
      }
    };
    SHOAL_RETURN_IF_ERROR(query(sql, take, key));
    return found;
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
  SHOAL_ASSIGN_OR_RETURN(database, open_store_database(path, access));
  return Store(std::make_unique<Impl>(std::move(database)));
}

Status Store::for_each_item(const std::function<void(const ItemRow&)>& take) {
  return impl_->query(kSelectItems, [&](const SqlStatement& row) { take(read_item(row)); });
}

Status Store::for_each_output(const std::function<void(std::int64_t, OutputRecord)>& take) {
  return impl_->query(kSelectOutputs,
                      [&](const SqlStatement& row) { take(row.integer(0), read_output(row)); });
}

Result<std::unordered_map<std::string, ItemState>> Store::items() {
  std::unordered_map<std::string, ItemState> items;
  std::unordered_map<std::int64_t, ItemState*> by_id;
  SHOAL_RETURN_IF_ERROR(for_each_item([&](const ItemRow& row) {
    by_id[row.id] = &(items[std::string(row.name)] = state_of(row));
  }));
  SHOAL_RETURN_IF_ERROR(for_each_output([&](std::int64_t id, OutputRecord output) {
    const auto item = by_id.find(id);
    if (item != by_id.end()) item->second->outputs.push_back(std::move(output));
  }));
  return items;
}

Result<std::optional<InputState>> Store::find_input(std::string_view path) {
  std::optional<InputState> input;
  SHOAL_RETURN_IF_ERROR(impl_->query(
      "SELECT size, mtime_ns, content_hash FROM inputs WHERE path = ?",
      [&](const SqlStatement& row) {
        input = {static_cast<std::uint64_t>(row.integer(0)), row.integer(1), row.text(2)};
      },
      path));
  return input;
}

Result<std::optional<Projection>> Store::find_projection(std::string_view name) {
  auto found = impl_->find_projection(kSelectProjectionByName, name);
  if (!found) found.error().where = name;
  return found;
}

Result<std::optional<Projection>> Store::find_projection(std::int64_t item) {
  return impl_->find_projection(kSelectProjectionByItem, item);
}

Status Store::read_in_one(const std::function<Status()>& work) {
  SHOAL_RETURN_IF_ERROR(flush());
  SHOAL_RETURN_IF_ERROR(impl_->run("BEGIN"));
  Status done = work();
  Status ended = impl_->run("COMMIT");
  return done ? std::move(ended) : std::move(done);
}

Status Store::record_input(std::string_view path, const InputState& state) {
  return impl_->write([&] { return impl_->replace_input(path, state); });
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
