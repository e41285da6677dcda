#pragma once
#include <unistd.h>

#include <utility>

namespace reachlab::os {

/// A descriptor of an open file or folder, or -1. Closes it in the end. Move-only.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) noexcept : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  operator int() const noexcept { return number_; }  // NOLINT: every call of the system takes it so

 private:
  int number_;
};

}  // namespace reachlab::os
