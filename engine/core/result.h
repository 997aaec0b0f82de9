// Result<T>: the one way in which something that can fail returns.
//
// Exceptions of libraries are caught at the border where they enter and become an Error there.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace shoal {

// What kind of failure, for exit statuses and for the store. The text is what a person reads.
enum class ErrorCode {
  usage,         // the command line or manifest asks for something that makes no sense
  not_found,     // a file or name does not exist
  unreadable,    // the operating system refuses or breaks off
  unsupported,   // a valid file of a kind that shoal does not read
  malformed,     // a file that breaks its own format's rules
  pixels,        // pixel values that the pixel policy forbids
  write_failed,  // an output could not be written
  interrupted,   // the user asked to stop
  internal,      // a bug in shoal
};

// One failure, told for a person: what went wrong and why, where, and what to do next.
struct Error {
  ErrorCode code = ErrorCode::internal;
  std::string what;   // what went wrong, and why: "row 17 ends after 203 of 1024 pixels"
  std::string where;  // file, file:row, or file:line:column; may be empty
  std::string hint;   // what to do next; may be empty

  // "where: what (hint)", leaving out what is empty.
  [[nodiscard]] std::string text() const;
};

template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  explicit operator bool() const { return state_.index() == 0; }
  [[nodiscard]] bool ok() const { return state_.index() == 0; }

  // Precondition: ok().
  T& value() & { return *std::get_if<0>(&state_); }
  const T& value() const& { return *std::get_if<0>(&state_); }
  T&& value() && { return std::move(*std::get_if<0>(&state_)); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  // Precondition: !ok().
  Error& error() & { return *std::get_if<1>(&state_); }
  const Error& error() const& { return *std::get_if<1>(&state_); }
  Error&& error() && { return std::move(*std::get_if<1>(&state_)); }

 private:
  std::variant<T, Error> state_;
};

template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}

  explicit operator bool() const { return !error_; }
  [[nodiscard]] bool ok() const { return !error_; }

  // Precondition: !ok().
  Error& error() & { return *error_; }
  const Error& error() const& { return *error_; }
  Error&& error() && { return std::move(*error_); }

 private:
  std::optional<Error> error_;
};

using Status = Result<void>;

}  // namespace shoal

// Returns the error of `expression` from the enclosing function, or goes on.
#define SHOAL_RETURN_IF_ERROR(expression)                  \
  do {                                                     \
    if (auto shoal_status = (expression); !shoal_status) { \
      return std::move(shoal_status).error();              \
    }                                                      \
  } while (false)

// Declares `name` with the value of `expression`, or returns its error from the enclosing function.
#define SHOAL_ASSIGN_OR_RETURN(name, expression)                           \
  auto shoal_result_##name = (expression);                                 \
  if (!shoal_result_##name) return std::move(shoal_result_##name).error(); \
  auto name = std::move(shoal_result_##name).value()
