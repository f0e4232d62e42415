#include "core/io/vtu_reader.hpp"

#include <fmt/format.h>

#include "core/mesh/structured.hpp"
#include "curved_meshes.hpp"
#include "tests/core/mesh/mesh_checks.hpp"
#include "vtu_samples.hpp"

namespace signorini {
namespace {

using test::input_error_of;
using test::sample_of;
using test::VtuData;
using test::VtuVariant;
using test::VtuWriter;
using testing::AllOf;
using testing::HasSubstr;

std::vector<VtuVariant> all_variants() {
  std::vector<VtuVariant> all{
      {VtuData::ascii}, {VtuData::binary, false, false, false, true}, {VtuData::base64, false, true, false, true}};
  for (const VtuData data : {VtuData::binary, VtuData::raw, VtuData::base64})
    for (const bool compressed : {false, true})
      for (const bool wide : {false, true})
        for (const bool swapped : {false, true}) all.push_back({data, compressed, wide, swapped, false});
  return all;
}

class Vtu : public testing::TestWithParam<VtuVariant> {};

template <int D>
void expect_read_back(const Mesh<D>& mesh, VtuVariant variant) {
  const auto read = std::get<Mesh<D>>(read_vtu(VtuWriter(sample_of(mesh), variant).write(), "file.vtu"));
  test::expect_consistent(read);
  EXPECT_EQ(read.points, mesh.points);
  EXPECT_EQ(read.elements, mesh.elements);
  ASSERT_EQ(read.parts.size(), mesh.parts.size());
  for (std::size_t k = 0; k < mesh.parts.size(); ++k)
    EXPECT_EQ(faces_of(read, fmt::format("{}", k + 1), "test"), mesh.parts[k].faces);
}

TEST_P(Vtu, GivesBackAPlate) { expect_read_back(rectangle({0, 0}, {3, 2}, {3, 2}), GetParam()); }
TEST_P(Vtu, GivesBackABrick) { expect_read_back(box({0, 0, 0}, {1, 2, 3}, {1, 2, 3}), GetParam()); }

TEST_P(Vtu, QuadraticCellsAreCurved) {
  const auto read = [&](const test::Sample& s) { return read_vtu(VtuWriter(s, GetParam()).write(), "file.vtu"); };
  test::expect_curved<2>(rectangle({0, 0}, {3, 2}, {3, 2}), read, true);
  test::expect_curved<3>(box({0, 0, 0}, {1, 2, 3}, {1, 2, 3}), read, true);
}

TEST_P(Vtu, CutOffAnywhereIsAnError) {
  const std::string file = VtuWriter(sample_of(rectangle({0, 0}, {1, 1}, {1, 1})), GetParam()).write();
  ASSERT_NO_THROW(read_vtu(file, "file.vtu"));
  for (std::size_t size = 0; size + 1 < file.size(); ++size)
    EXPECT_THROW(read_vtu(file.substr(0, size), "file.vtu"), Error) << "cut after byte " << size;
}

TEST_P(Vtu, DamagedBytesDoNoHarm) {
  const std::string file = VtuWriter(sample_of(rectangle({0, 0}, {1, 1}, {1, 1})), GetParam()).write();
  for (std::size_t i = 0; i < file.size(); ++i)
    for (const char damage : {'\xff', '9'}) {
      std::string damaged = file;
      damaged[i] = damage;
      try {
        read_vtu(damaged, "file.vtu");
      } catch (const Error& error) {
        EXPECT_EQ(error.status(), Exit::input);
      }
    }
}

std::string variant_name(const testing::TestParamInfo<VtuVariant>& variant) {
  const VtuVariant v = variant.param;
  const char* names[] = {"ascii", "binary", "raw", "base64"};
  return fmt::format("{}{}{}{}{}", names[static_cast<int>(v.data)], v.compressed ? "Zlib" : "",
                     v.wide_headers ? "Wide" : "", v.swapped ? "Swapped" : "", v.split_base64 ? "Split" : "");
}

INSTANTIATE_TEST_SUITE_P(Variants, Vtu, testing::ValuesIn(all_variants()), variant_name);

std::string triangle(const std::string& old = "", const std::string& fresh = "") {
  std::string file = R"(<VTKFile type="UnstructuredGrid" byte_order="LittleEndian">
<UnstructuredGrid>
<Piece NumberOfPoints="3" NumberOfCells="1">
<Points>
<DataArray type="Float32" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray>
</Points>
<Cells>
<DataArray type="Int32" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">3</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5</DataArray>
</Cells>
</Piece>
</UnstructuredGrid>
</VTKFile>
)";
  const std::size_t at = file.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return file.replace(at, old.size(), fresh);
}

std::string complaint(const std::string& old, const std::string& fresh) {
  return input_error_of([&] { read_vtu(triangle(old, fresh), "file.vtu"); });
}

TEST(VtuErrors, NameTheLineAndWhatIsWrong) {
  EXPECT_NO_THROW(read_vtu(triangle(), "file.vtu"));
  EXPECT_THAT(complaint("UnstructuredGrid\" b", "PolyData\" b"),
              AllOf(HasSubstr("file.vtu:1:"), HasSubstr("PolyData")));
  EXPECT_THAT(complaint("0 1 2", "0 1 3"), AllOf(HasSubstr("cell 0"), HasSubstr("vertex 3")));
  EXPECT_THAT(complaint("0 1 2", "0 1 x"), AllOf(HasSubstr("file.vtu:8:"), HasSubstr("'x'")));
  EXPECT_THAT(complaint("0 1 2", "0 1"), AllOf(HasSubstr("connectivity"), HasSubstr("2 numbers, expected 3")));
  EXPECT_THAT(complaint(">5<", ">9<"), AllOf(HasSubstr("cell 0"), HasSubstr("quadrilateral")));
  EXPECT_THAT(complaint(">5<", ">22<"), HasSubstr("cell 0 has 3 vertices, expected 6"));
  EXPECT_THAT(complaint(">5<", ">25<"), HasSubstr("quadratic hexahedron"));
  EXPECT_THAT(complaint(">3<", ">-3<"), HasSubstr("offsets"));
  EXPECT_THAT(complaint("0 0 0 1 0 0", "0 nan 0 1 0 0"), AllOf(HasSubstr("point 0"), HasSubstr("nan")));
  EXPECT_THAT(complaint("NumberOfPoints=\"3\"", "NumberOfPoints=\"2000000000\""), HasSubstr("9 numbers"));
  EXPECT_THAT(complaint("NumberOfPoints=\"3\"", "NumberOfPoints=\"many\""), HasSubstr("'many'"));
  EXPECT_THAT(complaint("Int32", "Int31"), HasSubstr("Int31"));
  EXPECT_THAT(complaint("\"LittleEndian\"", "\"LittleEndian\" compressor=\"vtkLZ4DataCompressor\""),
              AllOf(HasSubstr("vtkLZ4DataCompressor"), HasSubstr("vtkZLibDataCompressor")));
  EXPECT_THAT(complaint("</Cells>", "</Cell>"), AllOf(HasSubstr("file.vtu:11"), HasSubstr("XML")));
  EXPECT_THAT(complaint("\"types\"", "\"type\""), HasSubstr("'types'"));
}

}  // namespace
}  // namespace signorini
