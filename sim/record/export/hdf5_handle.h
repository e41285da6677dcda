#pragma once
#include <hdf5.h>

#include <utility>

namespace reachlab::record {

/// A call of the HDF5 library failed. The caller knows the file and says so in one sentence.
struct Hdf5Fault {};

inline hid_t checked(hid_t id) {
  if (id < 0) throw Hdf5Fault{};
  return id;
}
inline void done(herr_t status) {
  if (status < 0) throw Hdf5Fault{};
}

/// An identifier of HDF5 with the function that gives it back.
class Handle {
 public:
  Handle(hid_t id, herr_t (*giveBack)(hid_t)) : id_(checked(id)), giveBack_(giveBack) {}
  ~Handle() {
    if (id_ >= 0) giveBack_(id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), giveBack_(other.giveBack_) {}
  Handle& operator=(Handle&&) = delete;
  /// Gives it back now. What is written to the file by that may fail.
  void close() { done(giveBack_(std::exchange(id_, -1))); }
  operator hid_t() const { return id_; }  // NOLINT: every call of the library takes it so

 private:
  hid_t id_;
  herr_t (*giveBack_)(hid_t);
};

}  // namespace reachlab::record
