#pragma once
// Why a step of a combination is given up: the first reason counts.

#include <string>
#include <utility>

#include "base/result.h"

namespace trimloop::boolean {

class FirstError {
 public:
  void keep(std::string text, double measured = not_measured) {
    if (!*this) error_ = {ErrorCode::Unsupported, std::move(text), measured, not_measured};
  }
  void keep(const Error& e) {
    if (!*this) error_ = e;
  }
  explicit operator bool() const { return !error_.text.empty(); }
  const Error& error() const { return error_; }

 private:
  Error error_;
};

}  // namespace trimloop::boolean
