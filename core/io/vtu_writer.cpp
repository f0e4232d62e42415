#include "core/io/vtu_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <utility>

#include "core/base/crew.hpp"
#include "core/base/error.hpp"
#include "core/io/vtu_pack.hpp"

namespace signorini {
namespace {

/// Fills a file beside `path` and gives it this name when all went well.
void write_file(const std::filesystem::path& path, const std::function<void(std::ostream&)>& fill) {
  const std::filesystem::path temporary = path.string() + ".part";
  std::ofstream file(temporary, std::ios::binary);
  fill(file);
  file.close();
  std::error_code failure;
  if (!file)
    failure = std::error_code(errno, std::generic_category());
  else
    std::filesystem::rename(temporary, path, failure);
  if (!failure) return;
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  input_error(path.string(), fmt::format("cannot be written: {}", failure.message()));
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

/// The arrays of a file: their descriptions in XML first, their numbers, packed, at the end.
class Arrays {
 public:
  explicit Arrays(const VtuPacking& packing) : worthwhile_(packing.worthwhile), crew_(packing.threads) {}

  /// Keeps a reference to the values.
  template <class T>
  std::string add(const char* type, const std::string& name, int components, std::span<const T> values) {
    const std::string xml = fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n", type,
        escaped(name), components, offset_);
    const auto bytes = std::as_bytes(values);
    packed_.emplace_back(std::span(reinterpret_cast<const char*>(bytes.data()), bytes.size()), worthwhile_, crew_);
    offset_ += packed_.back().size();
    return xml;
  }

  /// Numbers that are made for the file: where they are until it is written.
  template <class T>
  const std::vector<T>& keep(std::vector<T> values) {
    auto kept = std::make_shared<const std::vector<T>>(std::move(values));
    kept_.push_back(kept);
    return *kept;
  }

  void write(std::ostream& out) const {
    for (const PackedVtu& array : packed_) array.write(out);
  }

 private:
  double worthwhile_;
  Crew crew_;
  std::size_t offset_ = 0;
  std::vector<PackedVtu> packed_;
  std::vector<std::shared_ptr<const void>> kept_;
};

/// Vectors of two components become such of three.
std::vector<double> padded(const std::vector<double>& values) {
  std::vector<double> result;
  result.reserve(values.size() / 2 * 3);
  for (std::size_t i = 0; i < values.size(); i += 2) result.insert(result.end(), {values[i], values[i + 1], 0.0});
  return result;
}

std::string describe(Arrays& arrays, const std::vector<VtuField>& fields, [[maybe_unused]] std::size_t places) {
  std::string xml;
  for (const VtuField& field : fields) {
    assert(field.values.size() == places * static_cast<std::size_t>(field.components));
    xml += field.components == 2 ? arrays.add<double>("Float64", field.name, 3, arrays.keep(padded(field.values)))
                                 : arrays.add<double>("Float64", field.name, field.components, field.values);
  }
  return xml;
}

std::string describe(const std::vector<VtuMark>& marks) {
  std::string xml;
  for (const VtuMark& mark : marks)
    xml += fmt::format("<DataArray type=\"Int32\" Name=\"{}\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n",
                       escaped(mark.name), mark.value);
  return xml.empty() ? xml : fmt::format("<FieldData>\n{}</FieldData>\n", xml);
}

/// Where each element's vertices end.
template <class T>
std::vector<T> offsets(std::size_t elements, T vertices) {
  std::vector<T> ends(elements);
  std::generate(ends.begin(), ends.end(), [end = T{0}, vertices]() mutable { return end += vertices; });
  return ends;
}

/// @param type of VTK
template <std::size_t N>
std::string describe_cells(Arrays& arrays, const std::vector<std::array<Index, N>>& cells, std::uint8_t type) {
  const std::size_t vertices = cells.size() * N;
  const bool few = vertices <= std::numeric_limits<Index>::max();
  const std::span connectivity(cells.empty() ? nullptr : cells.front().data(), vertices);
  std::string xml = arrays.add<Index>("Int32", "connectivity", 1, connectivity);
  xml += few ? arrays.add<Index>("Int32", "offsets", 1, arrays.keep(offsets<Index>(cells.size(), N)))
             : arrays.add<Offset>("Int64", "offsets", 1, arrays.keep(offsets<Offset>(cells.size(), N)));
  return xml + arrays.add<std::uint8_t>("UInt8", "types", 1, arrays.keep(std::vector(cells.size(), type)));
}

/// VTK goes around each triangle, and then up to the last corner: edges 01 12 02 and 01 12 02 03 13 23.
template <int D>
std::vector<Family<D>> in_order_of_vtk(std::vector<Family<D>> cells) {
  for (Family<D>& cell : cells) {
    if constexpr (D == 2) {
      std::swap(cell[4], cell[5]);  // 02 12
    } else {
      const Index e03 = cell[6];
      cell[6] = std::exchange(cell[5], cell[7]);  // 02 03 12
      cell[7] = e03;
    }
  }
  return cells;
}

template <int D>
std::string describe_cells(Arrays& arrays, const Mesh<D>& mesh, int order) {
  constexpr std::uint8_t triangle = 5, tetrahedron = 10, quadratic_triangle = 22, quadratic_tetrahedron = 24;
  if (order == 1) return describe_cells(arrays, mesh.elements, D == 2 ? triangle : tetrahedron);
  return describe_cells(arrays, arrays.keep(in_order_of_vtk<D>(mesh.families)),
                        D == 2 ? quadratic_triangle : quadratic_tetrahedron);
}

template <int D>
std::vector<double> coordinates(const Mesh<D>& mesh) {
  std::vector<double> x;
  x.reserve(mesh.points.size() * 3);
  for (const Point<D>& p : mesh.points)
    for (int k = 0; k < 3; ++k) x.push_back(k < D ? p[k] : 0.0);
  return x;
}

}  // namespace

template <int D>
void write_vtu(const std::filesystem::path& path, const Mesh<D>& mesh, const std::vector<VtuField>& point_fields,
               const std::vector<VtuField>& cell_fields, const VtuPacking& packing, int order,
               const std::vector<VtuMark>& marks) {
  const std::size_t count = order == 1 ? mesh.elements.size() : mesh.families.size();
  Arrays arrays(packing);
  const std::string points = arrays.add<double>("Float64", "Points", 3, arrays.keep(coordinates(mesh)));
  const std::string cells = describe_cells(arrays, mesh, order);
  const std::string point_data = describe(arrays, point_fields, mesh.points.size());
  const std::string cell_data = describe(arrays, cell_fields, count);
  write_file(path, [&](std::ostream& out) {
    out << fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" "
        "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n{}<Piece "
        "NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n"
        "<PointData>\n{}</PointData>\n<CellData>\n{}</CellData>\n<Points>\n{}</Points>\n<Cells>\n{}</Cells>\n"
        "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_",
        std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian", describe(marks), mesh.points.size(),
        count, point_data, cell_data, points, cells);
    arrays.write(out);
    out << "\n</AppendedData>\n</VTKFile>\n";
  });
}

void write_pvd(const std::filesystem::path& path, const std::vector<PvdEntry>& entries) {
  write_file(path, [&](std::ostream& out) {
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
    for (const PvdEntry& entry : entries)
      out << fmt::format("<DataSet timestep=\"{}\" part=\"{}\" file=\"{}\"/>\n", entry.time, entry.part,
                         escaped(entry.file));
    out << "</Collection>\n</VTKFile>\n";
  });
}

template void write_vtu(const std::filesystem::path&, const Mesh<2>&, const std::vector<VtuField>&,
                        const std::vector<VtuField>&, const VtuPacking&, int, const std::vector<VtuMark>&);
template void write_vtu(const std::filesystem::path&, const Mesh<3>&, const std::vector<VtuField>&,
                        const std::vector<VtuField>&, const VtuPacking&, int, const std::vector<VtuMark>&);

}  // namespace signorini
