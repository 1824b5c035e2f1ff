#pragma once
// Result<T>: a value, or the Error that says honestly why there is none (docs/architecture.md, "Errors").
// Library code neither throws nor prints; an operation that may fail returns a Result.

#include <limits>
#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace trimloop {

enum class ErrorCode {
  InvalidArgument,  // the caller's data breaks a documented precondition (knots descending, NaN, ...)
  Degenerate,       // the question has no answer for this shape (zero length, zero normal, ...)
  NoConvergence,    // an iteration ended before its tolerance
  Unsupported,      // legal, but not something this version can do
  NotFound,         // nothing of that name
  Limit,            // a ceiling of base/limits.h was reached
  Cancelled,        // the caller's stop token was set
  Io                // the operating system refused
};

constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

struct Error {
  ErrorCode code = ErrorCode::InvalidArgument;
  std::string text;                // one sentence for a person: what, where, how much
  double measured = not_measured;  // the value found, when there is one
  double limit = not_measured;     // the value allowed
};

template <class T>
using Result = tl::expected<T, Error>;

// `return fail(ErrorCode::Degenerate, "axis has zero length", 0.0, 1e-12);`
inline tl::unexpected<Error> fail(ErrorCode code, std::string text, double measured = not_measured,
                                  double limit = not_measured) {
  return tl::unexpected<Error>(Error{code, std::move(text), measured, limit});
}

}  // namespace trimloop
