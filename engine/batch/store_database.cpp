#include "batch/store_database.h"

#include <string>
#include <system_error>

#include "batch/store_schema.h"

namespace shoal {
namespace {

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

Result<SqlDatabase> open_store_database(const std::filesystem::path& path, Store::Access access) {
  std::error_code ignored;
  if (access == Store::Access::write) {
    SHOAL_RETURN_IF_ERROR(prepare_folder(path));
  } else if (!std::filesystem::exists(path, ignored)) {
    return no_store(path);
  }
  const auto create = access == Store::Access::write ? SqlDatabase::Create::when_missing
                                                     : SqlDatabase::Create::never;
  SHOAL_ASSIGN_OR_RETURN(database, SqlDatabase::open(path, create));
  SHOAL_RETURN_IF_ERROR(database.execute("PRAGMA foreign_keys = ON; PRAGMA cache_size = -32768"));
  if (access == Store::Access::write) {
    SHOAL_ASSIGN_OR_RETURN(id, database.integer_of("PRAGMA application_id"));
    if (id == 0) SHOAL_RETURN_IF_ERROR(make_schema(database, path));
  } else {
    SHOAL_RETURN_IF_ERROR(database.execute("PRAGMA query_only = ON"));
    SHOAL_ASSIGN_OR_RETURN(empty, is_empty(database));
    if (empty) return no_store(path);
  }
  SHOAL_RETURN_IF_ERROR(check_version(database, path));
  return database;
}

}  // namespace shoal
