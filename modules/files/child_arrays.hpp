// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace insonify {

namespace detail {
/// True if a value is sent as its bytes.
template <typename Value>
constexpr bool is_plain = std::is_trivially_copyable_v<Value> && !std::is_pointer_v<Value>;
template <typename Value, int Rows, int Columns, int Options>
constexpr bool is_plain<Eigen::Matrix<Value, Rows, Columns, Options>> = (Rows > 0 && Columns > 0);
template <typename Value, int Dimensions, int Mode, int Options>
constexpr bool is_plain<Eigen::Transform<Value, Dimensions, Mode, Options>> = true;
}  // namespace detail

/// Memory for what a reader sends, which may be another process. Only addresses are reserved; pages take memory when
/// they are written.
class SharedMemory {
 public:
  /// Number of first bytes that no array uses: one number of the sender, the others for a reader process.
  static constexpr std::size_t head = 128, of_sender = 16;
  /// Returns the address of so many bytes that were mapped; null if there are not as many.
  using Map = std::function<char*(std::size_t bytes)>;

  /// Reserves `most` bytes, or half of what the user's limits leave if that is less. Throws std::bad_alloc.
  explicit SharedMemory(std::size_t most);
  /// Does the same by `map`.
  SharedMemory(std::size_t most, const Map& map);
  /// Takes over `bytes` bytes that are mapped.
  SharedMemory(char* start, std::size_t bytes) : bytes_(bytes), start_(start) {}
  ~SharedMemory();
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  /// Returns the address of the memory.
  char* start() const { return start_; }
  /// Returns the size of the memory [bytes].
  std::size_t bytes() const { return bytes_; }
  /// Returns where the values end that a sender left [bytes].
  std::size_t end_of_sent() const;
  /// Releases all but these values, which may only be read afterwards.
  void keep_sent();
  /// Gives back the whole pages within [begin, end).
  void give_back(std::size_t begin, std::size_t end) const;

 private:
  std::size_t bytes_ = 0;
  char* start_ = nullptr;
};

/// Sends values through memory, also to another process. To send a type of your own, define
/// `template <typename Stream> void pass(Stream&, T&)` beside it; the function names the members: stream(t.a, t.b).
class ArraySender {
 public:
  static constexpr std::size_t all_of_it = static_cast<std::size_t>(-1);  ///< no limit but the size of the memory
  /// `memory` may take `most` bytes, which may grow meanwhile, if it holds as many.
  explicit ArraySender(const SharedMemory& memory, const std::size_t& most = all_of_it)
      : memory_(memory), most_(most) {}
  ~ArraySender();
  /// Bytes that were sent.
  std::size_t used() const { return used_; }

  /// A position for bytes, at a multiple of 16. Throws std::bad_alloc.
  char* take(std::size_t bytes);

  /// Values that the receiver reads one by one, as a vector.
  template <typename Number>
  Number* take_array(std::size_t count) {
    static_assert(detail::is_plain<Number>);
    (*this)(count);
    return reinterpret_cast<Number*>(take(count * sizeof(Number)));
  }

  /// A position for a grid (core/grid.hpp) of numbers of so many bytes.
  char* take_grid(Eigen::Index rows, Eigen::Index columns, std::size_t bytes) {
    (*this)(rows, columns);
    return take(static_cast<std::size_t>(rows * columns) * bytes);
  }

  /// Sends values.
  template <typename... Values>
  void operator()(const Values&... values) {
    (send(values), ...);
  }

 private:
  void send_bytes(const void* bytes, std::size_t count) {
    if (count > 0) std::memcpy(take(count), bytes, count);
  }
  template <typename Value>
  void send(const Value& value) {
    if constexpr (detail::is_plain<Value>)
      send_bytes(&value, sizeof value);
    else
      pass(*this, const_cast<Value&>(value));
  }
  void send(const std::string& text) {
    send(text.size());
    send_bytes(text.data(), text.size());
  }
  template <typename Value>
  void send(const std::vector<Value>& values) {
    send(values.size());
    if constexpr (detail::is_plain<Value>)
      send_bytes(values.data(), values.size() * sizeof(Value));
    else
      for (const Value& value : values) send(value);
  }
  template <typename Value>
  void send(const std::optional<Value>& value) {
    send(value.has_value());
    if (value) send(*value);
  }
  template <typename Value, int Rows, int Columns, int Options>
  void send(const Eigen::Array<Value, Rows, Columns, Options>& grid) {
    send(grid.rows(), grid.cols());
    send_bytes(grid.data(), static_cast<std::size_t>(grid.size()) * sizeof(Value));
  }
  template <typename First, typename... Others>
  void send(const First& first, const Others&... others) {
    send(first);
    (send(others), ...);
  }

  const SharedMemory& memory_;
  const std::size_t& most_;
  std::size_t used_ = 0;  // bytes
};

/// Receives the values of an ArraySender in the same order. Large arrays are released to the system as they are copied,
/// or can be used in place.
class ArrayReceiver {
 public:
  /// Reads the values that a sender left; error texts begin with `path`.
  ArrayReceiver(std::string path, std::shared_ptr<SharedMemory> memory);

  /// Where these bytes are; they live as long as `owner()`. Throws Error(content) if fewer were sent.
  const char* take(std::size_t bytes);
  /// The numbers of ArraySender::take_array where they are.
  template <typename Number>
  const Number* take_array(std::size_t& count) {
    (*this)(count);
    return reinterpret_cast<const Number*>(take(bytes_of(count, sizeof(Number))));
  }
  /// Returns the owner of the bytes of take().
  std::shared_ptr<const void> owner() const { return memory_; }

  /// Sets values to what was sent.
  template <typename... Values>
  void operator()(Values&... values) {
    (receive(values), ...);
  }

 private:
  std::size_t bytes_of(std::size_t count, std::size_t size) const;
  void copy(void* to, std::size_t bytes);
  template <typename Value>
  void receive(Value& value) {
    if constexpr (detail::is_plain<Value>)
      copy(&value, sizeof value);
    else
      pass(*this, value);
  }
  std::size_t receive_size(std::size_t size_of_one) {
    std::size_t count = 0;
    receive(count);
    bytes_of(count, size_of_one);  // before memory is taken for it
    return count;
  }
  void receive(std::string& text) {
    text.resize(receive_size(1));
    copy(text.data(), text.size());
  }
  template <typename Value>
  void receive(std::vector<Value>& values) {
    values.resize(receive_size(detail::is_plain<Value> ? sizeof(Value) : 1));
    if constexpr (detail::is_plain<Value>)
      copy(values.data(), values.size() * sizeof(Value));
    else
      for (Value& value : values) receive(value);
  }
  template <typename Value>
  void receive(std::optional<Value>& value) {
    bool there = false;
    receive(there);
    value.reset();
    if (there) receive(value.emplace());
  }
  template <typename Value, int Rows, int Columns, int Options>
  void receive(Eigen::Array<Value, Rows, Columns, Options>& grid) {
    Eigen::Index rows = 0, columns = 0;
    receive(rows);
    receive(columns);
    bytes_of(static_cast<std::size_t>(rows), bytes_of(static_cast<std::size_t>(columns), sizeof(Value)));
    grid.resize(rows, columns);
    copy(grid.data(), static_cast<std::size_t>(grid.size()) * sizeof(Value));
  }

  std::string path_;
  std::shared_ptr<SharedMemory> memory_;
  std::size_t at_ = 0, end_ = 0;
};

}  // namespace insonify
