// Files are exchanged with VTK itself, through Python. Without python3-vtk9 these tests fail, unless the environment
// variable SIGNORINI_SKIP_VTK is set.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "core/io/mesh_file.hpp"
#include "core/io/vtu_writer.hpp"
#include "core/mesh/refine.hpp"
#include "core/mesh/structured.hpp"
#include "tests/core/mesh/mesh_checks.hpp"
#include "tests/support/folder.hpp"

namespace signorini {
namespace {

namespace fs = std::filesystem;
using test::input_error_of;
using testing::HasSubstr;

class Vtk : public test::Folder {
 protected:
  /// Output of a script of this folder.
  static std::string run(const std::string& script, const fs::path& argument) {
    const std::string command =
        fmt::format("/usr/bin/python3 '{}/tests/core/io/{}' '{}'", SIGNORINI_SOURCE_DIR, script, argument.string());
    FILE* pipe = popen(command.c_str(), "r");
    std::string output;
    std::array<char, 4096> buffer;
    while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe)) output.append(buffer.data(), n);
    EXPECT_EQ(pclose(pipe), 0) << "needs the package python3-vtk9: " << command;
    return output;
  }

  static bool skipped() { return std::getenv("SIGNORINI_SKIP_VTK") != nullptr; }
};

std::vector<double> numbers_after(const std::string& text, const std::string& start) {
  const std::size_t at = text.find("\n" + start + " ");
  if (at == std::string::npos) return {};
  std::istringstream line(text.substr(at + start.size() + 2, text.find('\n', at + 1) - at - start.size() - 2));
  std::vector<double> numbers;
  for (double x; line >> x;) numbers.push_back(x);
  return numbers;
}

template <int D>
void expect_seen(const std::string& seen, const Mesh<D>& mesh, const std::vector<VtuField>& fields, const char* kind) {
  EXPECT_THAT(seen, HasSubstr(fmt::format("points {}\ncells {}\n", mesh.points.size(), mesh.elements.size())));
  const auto x = numbers_after(seen, "coordinates Points 3");
  ASSERT_EQ(x.size(), 3 * mesh.points.size());
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(x[3 * v + k], k < D ? mesh.points[v][k] : 0);
  for (const auto& element : mesh.elements)
    EXPECT_THAT(seen, HasSubstr(fmt::format("\ncell {} {}\n", D == 2 ? 5 : 10, fmt::join(element, " "))));
  for (const VtuField& field : fields) {
    const int components = field.components == 2 ? 3 : field.components;
    const auto values = numbers_after(seen, fmt::format("{} {} {}", kind, field.name, components));
    ASSERT_EQ(values.size() / components, field.values.size() / field.components) << field.name;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::size_t place = i / components, k = i % components;
      EXPECT_EQ(values[i], static_cast<int>(k) < field.components ? field.values[place * field.components + k] : 0);
    }
  }
}

VtuField field(const char* name, int components, std::size_t places) {
  VtuField result{name, components, {}};
  for (std::size_t i = 0; i < places * components; ++i) result.values.push_back(std::sin(1.0 + static_cast<double>(i)));
  return result;
}

template <int D>
void exchange(const Mesh<D>& mesh, const fs::path& file, const std::function<std::string()>& dump) {
  const std::vector<VtuField> at_points{field("displacement", D, mesh.points.size()),
                                        field("gap", 1, mesh.points.size())};
  const std::vector<VtuField> in_cells{field("stress", 9, mesh.elements.size()),
                                       field("von_mises", 1, mesh.elements.size())};
  write_vtu(file, mesh, at_points, in_cells);
  const std::string seen = dump();
  expect_seen(seen, mesh, at_points, "point");
  expect_seen(seen, mesh, in_cells, "element");
}

TEST_F(Vtk, OpensWhatIsWrittenIn2D) {
  if (skipped()) GTEST_SKIP() << "SIGNORINI_SKIP_VTK is set";
  const fs::path file = folder_ / "plate.vtu";
  exchange<2>(rectangle({0, 0}, {3, 2}, {3, 2}), file, [&] { return run("vtk_dump.py", file); });
}

TEST_F(Vtk, OpensWhatIsWrittenIn3D) {
  if (skipped()) GTEST_SKIP() << "SIGNORINI_SKIP_VTK is set";
  const fs::path file = folder_ / "brick.vtu";
  exchange<3>(box({0, 0, 0}, {1, 2, 3}, {1, 2, 3}), file, [&] { return run("vtk_dump.py", file); });
}

/// The edges whose midpoints follow the corners, in the order of VTK's file formats.
template <int D>
void expect_midpoints_where_vtk_has_them(const Mesh<D>& coarse, const fs::path& file,
                                         const std::function<std::string()>& dump) {
  const std::vector<std::array<int, 2>> edges =
      D == 2 ? std::vector<std::array<int, 2>>{{0, 1}, {1, 2}, {2, 0}}
             : std::vector<std::array<int, 2>>{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  Mesh<D> mesh;
  refine_uniformly(coarse, mesh);
  write_vtu(file, mesh, {field("gap", 1, mesh.points.size())}, {field("region", 1, coarse.elements.size())}, {}, 2);
  std::istringstream seen(dump());
  std::size_t cells = 0;
  for (std::string line; std::getline(seen, line);) {
    std::istringstream words(line);
    std::string word;
    int type = 0;
    if (!(words >> word >> type) || word != "cell") continue;
    ++cells;
    EXPECT_EQ(type, D == 2 ? 22 : 24);
    std::vector<std::size_t> node;
    for (std::size_t p; words >> p;) node.push_back(p);
    ASSERT_EQ(node.size(), D + 1 + edges.size());
    for (std::size_t k = 0; k < edges.size(); ++k)
      for (int i = 0; i < D; ++i)
        EXPECT_DOUBLE_EQ(mesh.points[node[D + 1 + k]][i],
                         (mesh.points[node[edges[k][0]]][i] + mesh.points[node[edges[k][1]]][i]) / 2);
  }
  EXPECT_EQ(cells, coarse.elements.size());
}

TEST_F(Vtk, SeesQuadraticCells) {
  if (skipped()) GTEST_SKIP() << "SIGNORINI_SKIP_VTK is set";
  const fs::path plate = folder_ / "plate.vtu", brick = folder_ / "brick.vtu";
  expect_midpoints_where_vtk_has_them<2>(rectangle({0, 0}, {3, 2}, {3, 2}), plate,
                                         [&] { return run("vtk_dump.py", plate); });
  expect_midpoints_where_vtk_has_them<3>(box({0, 0, 0}, {1, 2, 3}, {1, 2, 3}), brick,
                                         [&] { return run("vtk_dump.py", brick); });
}

TEST_F(Vtk, WritesNothingWeCannotRead) {
  if (skipped()) GTEST_SKIP() << "SIGNORINI_SKIP_VTK is set";
  run("vtk_write.py", folder_);
  int files = 0;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    const Mesh<2> mesh = read_mesh<2>(entry.path());
    test::expect_consistent(mesh);
    EXPECT_EQ(mesh.points, (std::vector<Point<2>>{{0, 0}, {1, 0}, {1, 1}, {0, 1}})) << entry.path();
    EXPECT_DOUBLE_EQ(test::area(mesh, "4"), 1);
    ++files;
  }
  EXPECT_EQ(files, 48);
}

class MeshFile : public Vtk {};

TEST_F(MeshFile, WrittenVtuIsReadBack) {
  const Mesh<3> mesh = box({0, 0, 0}, {1, 2, 3}, {1, 2, 3});
  write_vtu(folder_ / "brick.vtu", mesh, {field("name with <&\">", 3, mesh.points.size())});
  EXPECT_EQ(mesh_dimension(folder_ / "brick.vtu"), 3);
  const Mesh<3> read = read_mesh<3>(folder_ / "brick.vtu");
  EXPECT_EQ(read.points, mesh.points);
  EXPECT_EQ(read.elements, mesh.elements);
  EXPECT_THAT(input_error_of([&] { read_mesh<2>(folder_ / "brick.vtu"); }), HasSubstr("dimension 3, expected 2"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1) << "something was left behind";
}

TEST_F(MeshFile, PathsThatCannotBeUsedAreNamed) {
  EXPECT_THAT(input_error_of([&] { read_any_mesh(folder_ / "no.msh"); }), HasSubstr("no.msh: no such"));
  EXPECT_THAT(input_error_of([&] { read_any_mesh(folder_); }), HasSubstr("not a file"));
  std::ofstream(folder_ / "empty.msh") << "";
  EXPECT_THAT(input_error_of([&] { read_any_mesh(folder_ / "empty.msh"); }), HasSubstr("empty"));
  std::ofstream(folder_ / "noise.msh") << "solid";
  EXPECT_THAT(input_error_of([&] { read_any_mesh(folder_ / "noise.msh"); }), HasSubstr("$MeshFormat"));
  const Mesh<2> mesh = rectangle({0, 0}, {1, 1}, {1, 1});
  EXPECT_THAT(input_error_of([&] { write_vtu(folder_ / "missing" / "a.vtu", mesh, {}); }),
              HasSubstr("a.vtu: cannot be written"));
}

TEST_F(MeshFile, CollectionNamesTimesAndFiles) {
  write_pvd(folder_ / "solution.pvd", {{0.5, "solution_000.vtu"}, {1, "a&b.vtu"}});
  std::ostringstream text;
  text << std::ifstream(folder_ / "solution.pvd").rdbuf();
  EXPECT_THAT(text.str(), HasSubstr(R"(timestep="0.5" part="0" file="solution_000.vtu")"));
  EXPECT_THAT(text.str(), HasSubstr(R"(file="a&amp;b.vtu")"));
}

}  // namespace
}  // namespace signorini
