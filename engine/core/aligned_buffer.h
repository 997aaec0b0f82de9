// A block of trivially copyable elements at cache-line alignment, for planes, tables and scratch.
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

namespace shoal {

inline constexpr std::size_t kAlignment = 64;  // a cache line, and the widest vector

template <typename T>
class AlignedBuffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  AlignedBuffer() = default;
  explicit AlignedBuffer(std::size_t size) { resize_zeroed(size); }

  // Makes room for `size` elements; what they hold afterwards is unspecified. Never shrinks, so a
  // worker that reuses a buffer allocates only while it meets larger pictures.
  void resize_uninitialised(std::size_t size) {
    if (size > capacity_) {
      data_.reset(static_cast<T*>(::operator new (size * sizeof(T), std::align_val_t{kAlignment})));
      capacity_ = size;
    }
    size_ = size;
  }

  void resize_zeroed(std::size_t size) {
    resize_uninitialised(size);
    if (size > 0) std::memset(static_cast<void*>(data_.get()), 0, size * sizeof(T));
  }

  [[nodiscard]] T* data() { return data_.get(); }
  [[nodiscard]] const T* data() const { return data_.get(); }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] T& operator[](std::size_t index) { return data_.get()[index]; }
  [[nodiscard]] const T& operator[](std::size_t index) const { return data_.get()[index]; }
  [[nodiscard]] std::span<T> span() { return {data(), size_}; }
  [[nodiscard]] std::span<const T> span() const { return {data(), size_}; }

 private:
  struct Free {
    void operator()(T* block) const { ::operator delete (block, std::align_val_t{kAlignment}); }
  };
  std::unique_ptr<T, Free> data_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace shoal
