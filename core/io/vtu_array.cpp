#include "core/io/vtu_array.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "core/base/error.hpp"
#include "core/io/vtu_bytes.hpp"

namespace signorini {
namespace {

template <class T>
T from_bytes(const char* source, bool swapped) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, source, sizeof(T));
  if (swapped) std::reverse(bytes, bytes + sizeof(T));
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

template <class Stored, class T>
std::vector<T> convert(const std::string& bytes, bool swapped) {
  std::vector<T> numbers(bytes.size() / sizeof(Stored));
  for (std::size_t i = 0; i < numbers.size(); ++i)
    numbers[i] = static_cast<T>(from_bytes<Stored>(bytes.data() + i * sizeof(Stored), swapped));
  return numbers;
}

struct ArrayType {
  const char* name;
  std::size_t bytes;
  bool integer;
};
constexpr ArrayType array_types[] = {
    {"Float64", 8, false}, {"Float32", 4, false}, {"Int64", 8, true},  {"Int32", 4, true}, {"UInt8", 1, true},
    {"Int8", 1, true},     {"UInt32", 4, true},   {"UInt64", 8, true}, {"Int16", 2, true}, {"UInt16", 2, true}};

template <class T>
std::vector<T> convert(const ArrayType& type, const std::string& bytes, bool swapped) {
  const std::string_view name = type.name;
  if (name == "Float64") return convert<double, T>(bytes, swapped);
  if (name == "Float32") return convert<float, T>(bytes, swapped);
  if (name == "Int64") return convert<std::int64_t, T>(bytes, swapped);
  if (name == "Int32") return convert<std::int32_t, T>(bytes, swapped);
  if (name == "Int16") return convert<std::int16_t, T>(bytes, swapped);
  if (name == "Int8") return convert<std::int8_t, T>(bytes, swapped);
  if (name == "UInt64") return convert<std::uint64_t, T>(bytes, swapped);
  if (name == "UInt32") return convert<std::uint32_t, T>(bytes, swapped);
  if (name == "UInt16") return convert<std::uint16_t, T>(bytes, swapped);
  return convert<std::uint8_t, T>(bytes, swapped);
}

class ArrayReader {
 public:
  ArrayReader(const pugi::xml_node& array, Offset expected, const VtuFormat& format)
      : array_(array), expected_(expected), format_(format) {}

  template <class T>
  std::vector<T> read() const {
    const ArrayType type = stored_type();
    if (std::is_same_v<T, Offset> && !type.integer)
      fail(fmt::format("has type {}, expected an integer type", type.name));
    const std::string_view how = array_.attribute("format").as_string("ascii");
    std::vector<T> numbers;
    if (how == "ascii") {
      numbers = parse<T>(array_.child_value());
    } else if (how == "binary") {
      numbers = convert<T>(type, bytes(VtuBytes(array_.child_value(), true), type), format_.swapped);
    } else if (how == "appended") {
      numbers = convert<T>(type, bytes(appended(), type), format_.swapped);
    } else {
      fail(fmt::format("has format '{}', expected ascii, binary or appended", how));
    }
    if (static_cast<Offset>(numbers.size()) != expected_)
      fail(fmt::format("has {} numbers, expected {}", numbers.size(), expected_));
    return numbers;
  }

 private:
  [[noreturn]] void fail(std::string_view message) const {
    format_.fail(array_, fmt::format("array '{}' {}", array_.attribute("Name").as_string("Points"), message));
  }
  [[noreturn]] void truncated() const { fail("ends too early or is damaged"); }

  ArrayType stored_type() const {
    const std::string_view name = array_.attribute("type").as_string();
    for (const ArrayType& type : array_types)
      if (name == type.name) return type;
    fail(fmt::format("has type '{}', expected Float64, Int64, ...", name));
  }

  template <class T>
  std::vector<T> parse(std::string_view text) const {
    std::vector<T> numbers;
    const char* const end = text.data() + text.size();
    for (const char* p = text.data();;) {
      while (p != end && (*p == ' ' || *p == '\n' || *p == '\t' || *p == '\r')) ++p;
      if (p == end) return numbers;
      T value{};
      const auto [next, status] = std::from_chars(p, end, value);
      if (status != std::errc{})
        fail(fmt::format("has '{}' where a number is expected", std::string_view(p, std::min<Offset>(end - p, 20))));
      numbers.push_back(value);
      p = next;
    }
  }

  VtuBytes appended() const {
    const Offset offset = integer_attribute(array_, "offset", -1, format_);
    if (offset > static_cast<Offset>(format_.appended.size()))
      fail(fmt::format("starts at byte {} of {} appended ones", offset, format_.appended.size()));
    return VtuBytes(format_.appended.substr(offset), format_.appended_base64);
  }

  std::uint64_t header(VtuBytes& source) const {
    const auto bytes = source.read(format_.header_bytes);
    if (!bytes) truncated();
    return format_.header_bytes == 4 ? from_bytes<std::uint32_t>(bytes->data(), format_.swapped)
                                     : from_bytes<std::uint64_t>(bytes->data(), format_.swapped);
  }

  void check_size(std::uint64_t found, const ArrayType& type) const {
    if (found % type.bytes != 0 || found / type.bytes != static_cast<std::uint64_t>(expected_))
      fail(fmt::format("has {} bytes, expected {} numbers of {} bytes", found, expected_, type.bytes));
  }

  std::string bytes(VtuBytes source, const ArrayType& type) const {
    if (format_.compressed) return unpack(source, type);
    const std::uint64_t n = header(source);
    check_size(n, type);
    auto data = source.read(n);
    if (!data) truncated();
    return std::move(*data);
  }

  std::string unpack(VtuBytes& source, const ArrayType& type) const {
    const std::uint64_t blocks = header(source);
    if (blocks == 0) return {};
    const std::uint64_t block_size = header(source), partial = header(source);
    if (blocks > source.at_most() / format_.header_bytes || block_size > std::uint64_t{1} << 40 || partial > block_size)
      fail(fmt::format("announces {} blocks of {} bytes, more than the file can hold", blocks, block_size));
    const std::uint64_t last = partial == 0 ? block_size : partial;
    if (blocks - 1 > (std::uint64_t{1} << 62) / std::max<std::uint64_t>(block_size, 1)) truncated();
    check_size((blocks - 1) * block_size + last, type);
    std::vector<std::uint64_t> packed(blocks);
    for (std::uint64_t& size : packed) size = header(source);
    std::string all;
    for (std::uint64_t k = 0; k < blocks; ++k) {
      const auto data = source.read(packed[k]);
      const auto block = data ? inflate(*data, k + 1 == blocks ? last : block_size) : std::nullopt;
      if (!block) truncated();
      all += *block;
    }
    return all;
  }

  const pugi::xml_node& array_;
  Offset expected_;
  const VtuFormat& format_;
};

}  // namespace

void VtuFormat::fail(const pugi::xml_node& node, std::string_view message) const {
  const auto offset = std::clamp<Offset>(node.offset_debug(), 0, static_cast<Offset>(content.size()));
  const auto line = 1 + std::count(content.begin(), content.begin() + offset, '\n');
  input_error(fmt::format("{}:{}", place, line), message);
}

template <class T>
std::vector<T> read_array(const pugi::xml_node& array, Offset expected, const VtuFormat& format) {
  return ArrayReader(array, expected, format).read<T>();
}

template std::vector<double> read_array(const pugi::xml_node&, Offset, const VtuFormat&);
template std::vector<Offset> read_array(const pugi::xml_node&, Offset, const VtuFormat&);

Offset integer_attribute(const pugi::xml_node& node, const char* name, Offset fallback, const VtuFormat& format) {
  const std::string_view text = node.attribute(name).as_string();
  if (text.empty() && fallback >= 0) return fallback;
  Offset value = -1;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc{} || end != text.data() + text.size() || value < 0)
    format.fail(node, fmt::format("attribute {} of {} is '{}', expected an integer >= 0", name, node.name(), text));
  return value;
}

}  // namespace signorini
