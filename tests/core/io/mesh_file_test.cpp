#include "core/io/mesh_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/mesh/mesh_checks.hpp"

namespace signorini {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string complaint(const std::string& content, const std::string& place) {
  return test::input_error_of([&] { parse_mesh(content, place); });
}

TEST(ParseMesh, FormatsOfOtherProgramsAreNamedWithWhatToDo) {
  const std::string nastran = "$ written by hand\n$$ and so on\nSOL 101\nCEND\nBEGIN BULK\nGRID,1,,0.,0.,0.\nENDDATA\n";
  const std::string free = "GRID*                  1                              0.\nCTRIA3,1,1,1,2,3\n";
  for (const auto& [content, name] : {std::pair{nastran, "a.bdf"}, {nastran, "a"}, {free, "a.txt"}, {"x", "a.NAS"}})
    EXPECT_THAT(complaint(content, name),
                AllOf(HasSubstr(std::string(name) + ": a Nastran file"), HasSubstr("meshio convert OLD NEW.vtu")));
  EXPECT_THAT(
      complaint("*Heading\n*Node\n1, 0, 0, 0\n", "a.inp"),  // which Gmsh cannot read
      AllOf(HasSubstr("an Abaqus or CalculiX file"), HasSubstr("meshio convert OLD NEW.vtu"), Not(HasSubstr("gmsh"))));
  EXPECT_THAT(complaint("# vtk DataFile Version 3.0\n", "a.vtk"), HasSubstr("a legacy VTK file"));
  EXPECT_THAT(complaint("OFF\n3 1 0\n", "a.off"), AllOf(HasSubstr("an OFF file"), HasSubstr("shape = \"solid\"")));
  EXPECT_THAT(complaint("\x1f\x8b\x08", "a.msh.gz"), HasSubstr("packed by gzip"));
  EXPECT_THAT(complaint("hello", "a.msh"), HasSubstr("neither a Gmsh MSH file"));
}

TEST(ParseMesh, AFileOfVersion1NeedsNoHead) {
  const AnyMesh mesh =
      parse_mesh("$NOD\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$ENDNOD\n$ELM\n1\n1 2 0 1 3 1 2 3\n$ENDELM\n", "a.msh");
  EXPECT_EQ(std::get<Mesh<2>>(mesh).elements.size(), 1u);
}

// As editors and programs of other systems leave them.
TEST(ParseMesh, AByteOrderMarkAndZerosBehindTheEndSayNothing) {
  const std::string mesh =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n"
      "$Elements\n1\n1 2 0 1 2 3\n$EndElements\n";
  for (const std::string& content : {"\xEF\xBB\xBF" + mesh, mesh + std::string("\0\0\n", 3), mesh + "\x1a"})
    EXPECT_EQ(std::get<Mesh<2>>(parse_mesh(content, "a.msh")).elements.size(), 1u);
}

}  // namespace
}  // namespace signorini
