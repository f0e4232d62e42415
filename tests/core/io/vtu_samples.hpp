#pragma once
#include <fmt/format.h>

#include "mesh_samples.hpp"

namespace signorini::test {

enum class VtuData { ascii, binary, raw, base64 };

struct VtuVariant {
  VtuData data = VtuData::ascii;
  bool compressed = false;
  bool wide_headers = false;  ///< of 64 bits
  bool swapped = false;
  bool split_base64 = false;  ///< the header is encoded by itself, as meshio does
};

inline std::string base64(const std::string& bytes) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

/// A zlib stream that stores the bytes as they are (RFC 1950, 1951).
inline std::string stored_zlib(const std::string& bytes) {
  const auto n = static_cast<std::uint16_t>(bytes.size());
  ByteWriter stream;
  stream.out = "\x78\x01\x01";
  stream.add<std::uint16_t>(n);
  stream.add<std::uint16_t>(static_cast<std::uint16_t>(~n));
  stream.out += bytes;
  std::uint32_t a = 1, b = 0;
  for (const char c : bytes) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  for (const std::uint32_t byte : {b >> 8, b & 255, a >> 8, a & 255}) stream.out += static_cast<char>(byte);
  return stream.out;
}

/// Writes VTU files of all kinds, after the VTK user's guide; cells of one array of groups, their first physical one.
class VtuWriter {
 public:
  VtuWriter(const Sample& sample, VtuVariant variant) : sample_(sample), variant_(variant) {}

  std::string write() {
    std::vector<double> points;
    for (const auto& p : sample_.points) points.insert(points.end(), p.begin(), p.end());
    std::vector<std::int64_t> connectivity;
    std::vector<std::int32_t> offsets, groups;
    std::vector<std::uint8_t> types;
    for (const SampleBlock& block : sample_.blocks)
      for (const auto& cell : block.cells) {
        connectivity.insert(connectivity.end(), cell.begin(), cell.end());
        offsets.push_back(static_cast<std::int32_t>(connectivity.size()));
        groups.push_back(block.physicals[0]);
        constexpr int linear[] = {1, 3, 5, 10}, quadratic[] = {1, 21, 22, 24};
        const bool second = static_cast<int>(cell.size()) > block.dimension + 1;
        types.push_back(static_cast<std::uint8_t>((second ? quadratic : linear)[block.dimension]));
      }
    std::string file = fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" "
        "header_type=\"{}\"{}>\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
        (std::endian::native == std::endian::big) != variant_.swapped ? "BigEndian" : "LittleEndian",
        variant_.wide_headers ? "UInt64" : "UInt32", variant_.compressed ? " compressor=\"vtkZLibDataCompressor\"" : "",
        sample_.points.size(), types.size());
    file += "<CellData>\n" + array("Int32", "CellEntityIds", 1, groups) + "</CellData>\n";
    file += "<Points>\n" + array("Float64", "Points", 3, points) + "</Points>\n<Cells>\n";
    file += array("Int64", "connectivity", 1, connectivity) + array("Int32", "offsets", 1, offsets) +
            array("UInt8", "types", 1, types) + "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
    if (variant_.data >= VtuData::raw)
      file += fmt::format("<AppendedData encoding=\"{}\">\n_{}\n</AppendedData>\n",
                          variant_.data == VtuData::raw ? "raw" : "base64", appended_);
    return file + "</VTKFile>\n";
  }

 private:
  std::string headers(const std::vector<std::size_t>& numbers) const {
    ByteWriter writer(variant_.swapped);
    for (const std::size_t n : numbers)
      variant_.wide_headers ? writer.add<std::uint64_t>(n) : writer.add(static_cast<std::uint32_t>(n));
    return writer.out;
  }

  /// Header and data; in base64 unless raw.
  std::string encoded(const std::string& bytes) const {
    std::string header, data;
    if (variant_.compressed) {
      constexpr std::size_t block = 100;
      std::vector<std::size_t> sizes{(bytes.size() + block - 1) / block, block, bytes.size() % block};
      for (std::size_t i = 0; i < bytes.size(); i += block) {
        const std::string packed = stored_zlib(bytes.substr(i, block));
        sizes.push_back(packed.size());
        data += packed;
      }
      header = headers(sizes);
    } else {
      header = headers({bytes.size()});
      data = bytes;
    }
    if (variant_.data == VtuData::raw) return header + data;
    return variant_.compressed || variant_.split_base64 ? base64(header) + base64(data) : base64(header + data);
  }

  template <class T>
  std::string array(const char* type, const char* name, int components, const std::vector<T>& numbers) {
    const std::string open = fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"{}\"",
                                         type, name, components,
                                         variant_.data == VtuData::ascii    ? "ascii"
                                         : variant_.data == VtuData::binary ? "binary"
                                                                            : "appended");
    if (variant_.data == VtuData::ascii) {
      std::string text;
      for (const T x : numbers) text += fmt::format("{} ", x);
      return open + ">\n" + text + "\n</DataArray>\n";
    }
    ByteWriter writer(variant_.swapped);
    for (const T x : numbers) writer.add(x);
    const std::string data = encoded(writer.out);
    if (variant_.data == VtuData::binary) return open + ">\n  " + data + "\n</DataArray>\n";
    const std::size_t offset = appended_.size();
    appended_ += data;
    return open + fmt::format(" offset=\"{}\"/>\n", offset);
  }

  const Sample& sample_;
  VtuVariant variant_;
  std::string appended_;
};

}  // namespace signorini::test
