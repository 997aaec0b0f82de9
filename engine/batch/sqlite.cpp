#include "batch/sqlite.h"

#include <sqlite3.h>

#include <limits>

namespace shoal {
namespace {

// How long a statement waits for another process that writes.
constexpr int kBusyTimeoutMs = 30'000;

struct Verdict {
  ErrorCode code;
  const char* what;
  const char* hint;
};

// What SQLite's primary result codes mean to somebody who runs shoal.
Verdict verdict_of(int code) {
  switch (code & 0xff) {
    case SQLITE_NOTADB:
    case SQLITE_CORRUPT:
      return {ErrorCode::malformed, "the store is damaged",
              "delete it and run again: every panorama is then processed anew"};
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return {ErrorCode::unreadable, "the store is in use by another run",
              "wait until that run has ended, or give this one another output folder"};
    case SQLITE_FULL:
      return {ErrorCode::write_failed, "the store cannot grow",
              "free some space and run again; finished work is kept"};
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return {ErrorCode::write_failed, "the store cannot be written",
              "check the permissions of the store and of its folder"};
    case SQLITE_CANTOPEN:
      return {ErrorCode::unreadable, "the store cannot be opened",
              "check the permissions of the store and of its folder"};
    case SQLITE_IOERR:
      return {ErrorCode::unreadable, "the store cannot be read or written", "check the disk"};
    default:
      return {ErrorCode::internal, "the store does not answer", "please report this"};
  }
}

Error failure(sqlite3* database, int code) {
  const Verdict verdict = verdict_of(code);
  const char* path = database ? sqlite3_db_filename(database, "main") : nullptr;
  const char* reason = database ? sqlite3_errmsg(database) : sqlite3_errstr(code);
  return Error{verdict.code, std::string(verdict.what) + ": " + reason, path ? path : "",
               verdict.hint};
}

}  // namespace

void SqlStatement::Finalise::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

void SqlStatement::reset() {
  sqlite3_reset(statement_.get());
  bind_error_ = SQLITE_OK;
}

void SqlStatement::bind(int index, std::int64_t value) {
  const int code = sqlite3_bind_int64(statement_.get(), index, value);
  if (code != SQLITE_OK) bind_error_ = code;
}

void SqlStatement::bind(int index, double value) {
  const int code = sqlite3_bind_double(statement_.get(), index, value);
  if (code != SQLITE_OK) bind_error_ = code;
}

void SqlStatement::bind(int index, std::string_view value) {
  // A null pointer would bind NULL instead of the empty text.
  const char* text = value.empty() ? "" : value.data();
  const int code =
      sqlite3_bind_text64(statement_.get(), index, text, value.size(), SQLITE_STATIC, SQLITE_UTF8);
  if (code != SQLITE_OK) bind_error_ = code;
}

void SqlStatement::bind(int index, std::span<const std::byte> value) {
  const int code =
      sqlite3_bind_blob64(statement_.get(), index, value.data(), value.size(), SQLITE_STATIC);
  if (code != SQLITE_OK) bind_error_ = code;
}

void SqlStatement::bind(int index, std::nullptr_t) {
  const int code = sqlite3_bind_null(statement_.get(), index);
  if (code != SQLITE_OK) bind_error_ = code;
}

Result<SqlStatement::Step> SqlStatement::step() {
  sqlite3* database = sqlite3_db_handle(statement_.get());
  if (bind_error_ != SQLITE_OK) return failure(database, bind_error_);
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return Step::row;
  if (code == SQLITE_DONE) return Step::done;
  return failure(database, code);
}

std::int64_t SqlStatement::integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

double SqlStatement::real(int column) const {
  if (sqlite3_column_type(statement_.get(), column) == SQLITE_NULL) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return sqlite3_column_double(statement_.get(), column);
}

std::string SqlStatement::text(int column) const { return std::string(text_view(column)); }

std::string_view SqlStatement::text_view(int column) const {
  const void* bytes = sqlite3_column_text(statement_.get(), column);
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return bytes ? std::string_view(static_cast<const char*>(bytes), size) : std::string_view();
}

std::span<const std::byte> SqlStatement::blob(int column) const {
  const void* bytes = sqlite3_column_blob(statement_.get(), column);
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return {static_cast<const std::byte*>(bytes), static_cast<std::size_t>(size)};
}

void SqlDatabase::Close::operator()(sqlite3* database) const { sqlite3_close_v2(database); }

Result<SqlDatabase> SqlDatabase::open(const std::filesystem::path& path, Create create) {
  // The caller sees to it that one thread at a time comes here, so SQLite needs no mutex.
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX |
                    (create == Create::when_missing ? SQLITE_OPEN_CREATE : 0);
  sqlite3* handle = nullptr;
  const int code = sqlite3_open_v2(path.c_str(), &handle, flags, nullptr);
  SqlDatabase database;
  database.database_.reset(handle);
  if (code != SQLITE_OK) {
    Error error = failure(handle, code);
    error.where = path.string();
    return error;
  }
  sqlite3_extended_result_codes(handle, 1);
  sqlite3_busy_timeout(handle, kBusyTimeoutMs);
  return database;
}

Status SqlDatabase::execute(const char* statements) {
  const int code = sqlite3_exec(database_.get(), statements, nullptr, nullptr, nullptr);
  return code == SQLITE_OK ? Status() : failure(database_.get(), code);
}

Result<SqlStatement> SqlDatabase::prepare(std::string_view statement) {
  sqlite3_stmt* prepared = nullptr;
  const int code =
      sqlite3_prepare_v3(database_.get(), statement.data(), static_cast<int>(statement.size()),
                         SQLITE_PREPARE_PERSISTENT, &prepared, nullptr);
  if (code != SQLITE_OK) return failure(database_.get(), code);
  return SqlStatement(prepared);
}

Result<std::int64_t> SqlDatabase::integer_of(std::string_view statement) {
  SHOAL_ASSIGN_OR_RETURN(query, prepare(statement));
  query.start();
  SHOAL_RETURN_IF_ERROR(query.step());
  return query.integer(0);
}

bool SqlDatabase::in_transaction() const { return sqlite3_get_autocommit(database_.get()) == 0; }

}  // namespace shoal
