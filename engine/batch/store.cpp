#include "batch/store.h"

#include <utility>

#include "batch/store_connection.h"
#include "batch/store_database.h"
#include "batch/store_outputs.h"
#include "batch/store_projection.h"
#include "batch/store_quality.h"

namespace shoal {
namespace {

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

Status replace_input(StoreConnection& store, std::string_view path, const InputState& state) {
  return store.run("INSERT OR REPLACE INTO inputs VALUES (?,?,?,?)", path,
                   static_cast<std::int64_t>(state.size), state.mtime_ns, state.content_hash);
}

Status replace_item(StoreConnection& store, const ItemRecord& item) {
  const ItemState& state = item.state;
  if (item.input) SHOAL_RETURN_IF_ERROR(replace_input(store, state.input_path, *item.input));
  std::int64_t id = 0;
  SHOAL_RETURN_IF_ERROR(store.query(
      kUpsertItem, [&](const SqlStatement& row) { id = row.integer(0); }, item.name,
      name_of(state.status), state.error, state.input_path, state.input_hash, state.parameters,
      state.output_hash, state.algorithm_version, item.engine_version, item.timings.decode_seconds,
      item.timings.project_seconds, item.timings.write_seconds));
  SHOAL_RETURN_IF_ERROR(store.run("DELETE FROM outputs WHERE item = ?", id));
  for (const OutputRecord& output : state.outputs) {
    SHOAL_RETURN_IF_ERROR(store.run(kInsertOutput, id, output.path, output.kind,
                                    output.content_hash, static_cast<std::int64_t>(output.size)));
  }
  SHOAL_RETURN_IF_ERROR(store.run("DELETE FROM quality WHERE item = ?", id));
  std::int64_t position = 0;
  for (const VariantQuality& quality : item.quality) {
    SHOAL_ASSIGN_OR_RETURN(insert, store.statement(kInsertQuality));
    SHOAL_RETURN_IF_ERROR(write_quality(*insert, id, position++, quality));
  }
  SHOAL_RETURN_IF_ERROR(store.run("DELETE FROM projections WHERE item = ?", id));
  SHOAL_RETURN_IF_ERROR(store.run("DELETE FROM suns WHERE item = ?", id));
  if (!item.projection) return {};
  SHOAL_ASSIGN_OR_RETURN(insert, store.statement(kInsertProjection));
  SHOAL_RETURN_IF_ERROR(write_projection(*insert, id, *item.projection));
  if (!item.projection->sun) return {};
  SHOAL_ASSIGN_OR_RETURN(insert_sun, store.statement(kInsertSun));
  return write_sun(*insert_sun, id, *item.projection->sun);
}

template <typename Key>
Result<std::optional<Projection>> find_by(StoreConnection& store, const char* sql, const Key& key) {
  Result<std::optional<Projection>> found = std::optional<Projection>();
  const auto take = [&](const SqlStatement& row) {
    auto projection = read_projection(row);
    if (projection) {
      found = std::optional<Projection>(std::move(*projection));
    } else {
      found = std::move(projection).error();
    }
  };
  SHOAL_RETURN_IF_ERROR(store.query(sql, take, key));
  return found;
}

}  // namespace

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
  auto found = find_by(*impl_, kSelectProjectionByName, name);
  if (!found) found.error().where = name;
  return found;
}

Result<std::optional<Projection>> Store::find_projection(std::int64_t item) {
  return find_by(*impl_, kSelectProjectionByItem, item);
}

Result<std::vector<VariantQuality>> Store::find_quality(std::int64_t item) {
  std::vector<VariantQuality> found;
  SHOAL_RETURN_IF_ERROR(impl_->query(
      kSelectQuality, [&](const SqlStatement& row) { found.push_back(read_quality(row)); }, item));
  return found;
}

Status Store::read_in_one(const std::function<Status()>& work) {
  SHOAL_RETURN_IF_ERROR(flush());
  SHOAL_RETURN_IF_ERROR(impl_->run("BEGIN"));
  Status done = work();
  Status ended = impl_->run("COMMIT");
  return done ? std::move(ended) : std::move(done);
}

Status Store::record_input(std::string_view path, const InputState& state) {
  return impl_->write([&] { return replace_input(*impl_, path, state); });
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
  return impl_->write([&] { return replace_item(*impl_, item); });
}

Status Store::flush() { return impl_->commit(); }

}  // namespace shoal
