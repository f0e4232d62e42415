#include "core/io/msh_reader.hpp"

#include <fmt/format.h>

#include "core/mesh/structured.hpp"
#include "curved_meshes.hpp"
#include "msh_samples.hpp"
#include "tests/core/mesh/mesh_checks.hpp"

namespace signorini {
namespace {

using test::area;
using test::input_error_of;
using test::MshVariant;
using test::MshWriter;
using test::Sample;
using test::sample_of;
using testing::AllOf;
using testing::HasSubstr;

Mesh<2> plate() { return rectangle({0, 0}, {3, 2}, {3, 2}); }
Mesh<3> brick() { return box({0, 0, 0}, {1, 2, 3}, {1, 2, 3}); }
Mesh<2> smallest() { return rectangle({0, 0}, {1, 1}, {1, 1}); }

class Msh : public testing::TestWithParam<MshVariant> {};

template <int D>
void expect_read_back(const Mesh<D>& mesh, MshVariant variant) {
  const std::string file = MshWriter(sample_of(mesh), variant).write();
  const auto read = std::get<Mesh<D>>(read_msh(file, "file.msh"));
  test::expect_consistent(read);
  EXPECT_EQ(read.points, mesh.points);
  EXPECT_EQ(read.elements, mesh.elements);
  for (std::size_t k = 0; k < mesh.parts.size(); ++k) {
    const bool named = k % 2 == 0 && variant.version > 1;      // version 1 has no names
    const bool body_too = k + 1 == 5 && variant.version == 2;  // whose names are those of all dimensions
    const std::string name = body_too ? "the body" : named ? mesh.parts[k].name : fmt::format("{}", k + 1);
    EXPECT_EQ(faces_of(read, name, "test"), mesh.parts[k].faces) << name;
  }
  EXPECT_EQ(faces_of(read, "9", "test"), mesh.parts[0].faces);
  EXPECT_EQ(read.parts.size(), mesh.parts.size() + 1);
}

TEST_P(Msh, GivesBackAPlate) { expect_read_back(plate(), GetParam()); }
TEST_P(Msh, GivesBackABrick) { expect_read_back(brick(), GetParam()); }

TEST_P(Msh, SecondOrderElementsAreCurved) {
  test::expect_curved<2>(
      plate(), [&](const Sample& s) { return read_msh(MshWriter(s, GetParam()).write(), "file.msh"); }, false);
  test::expect_curved<3>(
      brick(), [&](const Sample& s) { return read_msh(MshWriter(s, GetParam()).write(), "file.msh"); }, false);
}

TEST_P(Msh, TellsGroupsThatAreNoParts) {
  Sample sample = sample_of(plate());
  FileGroups groups;
  read_msh(MshWriter(sample, GetParam()).write(), "file.msh", &groups);
  EXPECT_THAT(groups.of_elements, testing::Contains(testing::Key(GetParam().version > 1 ? "the body" : "5")));
  EXPECT_THAT(groups.off_boundary, testing::IsEmpty());
  sample.points.push_back({9, 9, 0.5});
  const auto loose = static_cast<Index>(sample.points.size()) - 1;
  sample.blocks[0].cells.push_back({4, 5});      // between two cells
  sample.blocks[0].cells.push_back({0, loose});  // of no element
  sample.blocks[0].cells.push_back(sample.blocks[0].cells[0]);
  read_msh(MshWriter(sample, GetParam()).write(), "file.msh", &groups);
  ASSERT_EQ(groups.off_boundary.size(), 2u);  // the first block is in two groups
  const auto nine = std::ranges::find(groups.off_boundary, "9", &FileGroups::OffBoundary::name);
  ASSERT_NE(nine, groups.off_boundary.end());
  EXPECT_EQ(nine->elsewhere, 2u);
  EXPECT_EQ(nine->faces, sample.blocks[0].cells.size() - 1);
}

TEST_P(Msh, CutOffAnywhereIsAnError) {
  const std::string file = MshWriter(sample_of(smallest()), GetParam()).write();
  ASSERT_NO_THROW(read_msh(file, "file.msh"));
  const std::size_t complete = file.find_last_not_of('\n') + 1;
  for (std::size_t size = 0; size < complete; ++size)
    EXPECT_THROW(read_msh(file.substr(0, size), "file.msh"), Error) << "cut after byte " << size;
}

/// Whatever happens to a byte: a mesh or an error, nothing else.
TEST_P(Msh, DamagedBytesDoNoHarm) {
  const std::string file = MshWriter(sample_of(smallest()), GetParam()).write();
  for (std::size_t i = 0; i < file.size(); ++i)
    for (const char damage : {'\0', '\xff', '9', '-', ' '}) {
      std::string damaged = file;
      damaged[i] = damage;
      try {
        read_msh(damaged, "file.msh");
      } catch (const Error& error) {
        EXPECT_EQ(error.status(), Exit::input);
      }
    }
}

std::string variant_name(const testing::TestParamInfo<MshVariant>& info) {
  const MshVariant v = info.param;
  return fmt::format("version{:.0f}{}{}{}", 10 * v.version, v.binary ? "binary" : "ascii", v.swapped ? "swapped" : "",
                     v.stride > 1 ? "sparse" : "");
}

INSTANTIATE_TEST_SUITE_P(Variants, Msh,
                         testing::Values(MshVariant{1}, MshVariant{2}, MshVariant{2, true}, MshVariant{2.2},
                                         MshVariant{2.2, true}, MshVariant{2.2, true, true}, MshVariant{4},
                                         MshVariant{4, true}, MshVariant{4, true, true}, MshVariant{4.1},
                                         MshVariant{4.1, true}, MshVariant{4.1, true, true},
                                         MshVariant{2.2, false, false, 97},
                                         MshVariant{4.1, true, false, 1'000'000'007}),
                         variant_name);

/// As Gmsh 4.11 writes it: a unit square of two triangles, groups on curves 1 and 3 and on the surface.
const std::string gmsh_41 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
3
1 1 "lower side"
1 2 "upper"
2 3 "domain"
$EndPhysicalNames
$Entities
4 4 1 0
1 0 0 0 0 
2 1 0 0 0 
3 1 1 0 0 
4 0 1 0 0 
1 0 0 0 1 0 0 1 1 2 1 -2 
2 1 0 0 1 1 0 0 2 2 -3 
3 0 1 0 1 1 0 1 2 2 3 -4 
4 0 0 0 0 1 0 0 2 4 -1 
1 0 0 0 1 1 0 1 3 4 1 2 3 4 
$EndEntities
$Nodes
5 5 1 5
0 1 0 1
1
0 0 0
0 2 0 1
2
1 0 0
0 3 0 1
3
1 1 0
0 4 0 1
4
0 1 0
2 1 0 1
5
0.5 0.5 0
$EndNodes
$Elements
3 6 1 6
1 1 1 1
1 1 2 
1 3 1 1
2 3 4 
2 1 2 4
3 2 5 1 
4 1 5 4 
5 3 5 2 
6 4 5 3 
$EndElements
)";

/// As Gmsh writes version 2.2: a tetrahedron with a group on one face.
const std::string gmsh_22 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
2 1 "base"
3 2 "volume"
$EndPhysicalNames
$Nodes
4
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
$EndNodes
$Elements
2
1 2 2 1 1 1 3 2
2 4 2 2 1 1 2 3 4
$EndElements
)";

std::string with(std::string text, const std::string& old, const std::string& fresh) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos);
  return text.replace(at, old.size(), fresh);
}

std::string complaint(const std::string& file) {
  return input_error_of([&] { read_msh(file, "file.msh"); });
}

TEST(MshExamples, SurfaceOfGmshThatIsNumberedClockwise) {
  const auto mesh = std::get<Mesh<2>>(read_msh(gmsh_41, "file.msh"));
  test::expect_consistent(mesh);
  EXPECT_EQ(mesh.elements.size(), 4u);
  EXPECT_DOUBLE_EQ(test::volume(mesh), 1);
  EXPECT_DOUBLE_EQ(area(mesh, "lower side"), 1);
  EXPECT_EQ(mesh.boundary[faces_of(mesh, "upper", "test").at(0)].vertices, (std::array<Index, 2>{2, 3}));
}

/// As version 1 has it: two triangles, one line in group 4.
const std::string gmsh_1 = R"($NOD
4
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
$ENDNOD
$ELM
3
1 2 1 1 3 1 2 3
2 2 1 1 3 1 3 4
3 1 4 1 2 1 2
$ENDELM
)";

TEST(MshExamples, SquareOfVersion1) {
  const auto mesh = std::get<Mesh<2>>(read_msh(gmsh_1, "file.msh"));
  test::expect_consistent(mesh);
  EXPECT_DOUBLE_EQ(test::volume(mesh), 1);
  EXPECT_DOUBLE_EQ(area(mesh, "4"), 1);
  EXPECT_THAT(complaint(with(gmsh_1, "1 1 3 1 3 4", "1 1 4 1 3 4 2")), HasSubstr("element 2 has 4 nodes, expected 3"));
  EXPECT_THAT(complaint(with(gmsh_1, "$ENDELM", "")), HasSubstr("ends where $ENDELM is expected"));
}

TEST(MshExamples, SectionsEndWithoutRegardToCaseAndBlanks) {
  const std::string file = "$Comments\nmade by hand\n  $ENDCOMMENTS\n" + gmsh_22;
  EXPECT_DOUBLE_EQ(area(std::get<Mesh<3>>(read_msh(file, "file.msh")), "base"), 0.5);
}

TEST(MshExamples, TetrahedronOfGmsh) {
  const auto mesh = std::get<Mesh<3>>(read_msh(gmsh_22, "file.msh"));
  test::expect_consistent(mesh);
  EXPECT_DOUBLE_EQ(area(mesh, "base"), 0.5);
}

TEST(MshExamples, WindowsLinesCommentsAndUnknownSectionsAreNoMatter) {
  std::string file = "$Comments\nmade by hand\n$EndComments\n" + gmsh_22 + "$NodeData\n1\n\"a\"\n$EndNodeData\n";
  for (std::size_t i = 0; (i = file.find('\n', i)) != std::string::npos; i += 2) file.replace(i, 1, "\r\n");
  EXPECT_DOUBLE_EQ(area(std::get<Mesh<3>>(read_msh(file, "file.msh")), "base"), 0.5);
}

TEST(MshExamples, NegativePhysicalTagsMeanTheSameGroup) {
  const auto mesh = std::get<Mesh<2>>(read_msh(with(gmsh_41, "0 0 1 1 2 1 -2", "0 0 1 -1 2 1 -2"), "file.msh"));
  EXPECT_DOUBLE_EQ(area(mesh, "lower side"), 1);
}

TEST(MshErrors, NameTheLineAndWhatIsWrong) {
  EXPECT_THAT(complaint(with(gmsh_22, "3 0 1 0", "3 0 x 0")), AllOf(HasSubstr("file.msh:13:"), HasSubstr("'x'")));
  EXPECT_THAT(complaint(with(gmsh_22, "3 0 1 0", "3 0 nan 0")), AllOf(HasSubstr("file.msh:13:"), HasSubstr("nan")));
  EXPECT_THAT(complaint(with(gmsh_22, "3 0 1 0", "3 0 1e999 0")), HasSubstr("file.msh:13:"));
  EXPECT_THAT(complaint(with(gmsh_22, "3 0 1 0", "2 0 1 0")), HasSubstr("node 2 is defined twice"));
  EXPECT_THAT(complaint(with(gmsh_22, "1 2 3 4\n", "1 2 3 9\n")),
              AllOf(HasSubstr("file.msh:19:"), HasSubstr("node 9")));
  EXPECT_THAT(complaint(with(gmsh_22, "1 2 3 4\n", "1 2 3 3\n")), AllOf(HasSubstr("element 2"), HasSubstr("twice")));
  EXPECT_THAT(complaint(with(gmsh_22, "4 0 0 1", "4 1 1 0")), AllOf(HasSubstr("element 2"), HasSubstr("degenerate")));
  EXPECT_THAT(complaint(with(gmsh_22, "2.2 0 8", "3.0 0 8")),
              HasSubstr("version 3, expected one of 1 | 2 | 2.1 | 2.2 | 4 | 4.1"));
  EXPECT_THAT(complaint(with(gmsh_22, "2.2 0 8", "2.2 0 4")), HasSubstr("data size 4"));
  EXPECT_THAT(complaint(with(gmsh_22, "$Nodes\n4", "$Nodes\n4000000000")), HasSubstr("4000000000 nodes"));
  EXPECT_THAT(complaint(with(gmsh_22, "$Nodes\n4", "$Nodes\n5")), HasSubstr("$EndNodes"));
  EXPECT_THAT(complaint(with(gmsh_22, "$EndNodes", "$EndNodse")), HasSubstr("$EndNodes"));
  EXPECT_THAT(complaint(with(gmsh_41, "3 6 1 6", "3 7 1 6")), HasSubstr("announced were 7"));
  EXPECT_THAT(complaint(with(gmsh_41, "3 6 1 6", "3 -7 1 6")), HasSubstr("found -7 elements, expected 0 or more"));
  EXPECT_THAT(complaint("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"), HasSubstr("no section $Nodes"));
  EXPECT_THAT(complaint(with(gmsh_22, "$EndNodes", "$End 4")), HasSubstr("file.msh:15: expected $EndNodes"));
  EXPECT_THAT(complaint("$Comments\na\n" + gmsh_22), HasSubstr("the file ends without $EndComments"));
}

TEST(MshErrors, NameTheTypeOfElementsThatAreNotRead) {
  for (const auto& [type, name] : {std::pair{3, "quadrangle"},
                                   {5, "hexahedron"},
                                   {6, "prism"},
                                   {7, "pyramid"},
                                   {21, "third-order triangle"},
                                   {10, "second-order quadrangle"},
                                   {93, "type 93"}})
    EXPECT_THAT(complaint(with(gmsh_22, "2 4 2 2 1", fmt::format("2 {} 2 2 1", type))),
                AllOf(HasSubstr("element 2"), HasSubstr(name)));
}

TEST(MshErrors, TellSurfacesInSpaceFromPlaneOnes) {
  EXPECT_THAT(complaint(with(gmsh_41, "0.5 0.5 0", "0.5 0.5 1")),
              HasSubstr("surface in space, its triangles with z from 0 to 1"));
}

TEST(MshErrors, WrongMarkerOfTheByteOrder) {
  std::string file = MshWriter(sample_of(smallest()), {2.2, true}).write();
  file[file.find("8\n") + 3] = 5;
  EXPECT_THAT(complaint(file), HasSubstr("byte order"));
}

TEST(Msh, ElementsNumberedTheOtherWayRoundAreTurned) {
  const auto turned = std::get<Mesh<2>>(read_msh(with(gmsh_41, "5 3 5 2", "5 3 2 5"), "file.msh"));
  const auto given = std::get<Mesh<2>>(read_msh(gmsh_41, "file.msh"));
  EXPECT_EQ(turned.points, given.points);
  ASSERT_EQ(turned.elements.size(), given.elements.size());
  for (std::size_t e = 0; e < given.elements.size(); ++e)
    EXPECT_EQ(sorted(turned.elements[e]), sorted(given.elements[e]));
}

TEST(MshErrors, DisconnectedMesh) {
  auto sample = sample_of(smallest());
  const Index n = static_cast<Index>(sample.points.size());
  for (Index i = 0; i < n; ++i) sample.points.push_back({sample.points[i][0] + 5, sample.points[i][1], 0.5});
  auto cells = sample.blocks.back().cells;
  for (auto& cell : cells)
    for (Index& v : cell) v += n;
  sample.blocks.push_back({2, 2, {5}, cells});
  EXPECT_THAT(complaint(MshWriter(sample, {4.1, true}).write()), HasSubstr("2 pieces"));
}

}  // namespace
}  // namespace signorini
