#include "core/io/surface_complaint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace signorini {
namespace {

std::string complaint(const std::string& name, const std::string& content) {
  const auto file = std::filesystem::temp_directory_path() / ("signorini-complaint-" + name);
  std::ofstream(file, std::ios::binary) << content;
  const std::string found = surface_complaint(file);
  std::filesystem::remove(file);
  return found;
}

TEST(SurfaceComplaint, NamesTheLineOfAnOffFile) {
  const std::string head = "OFF\n# a triangle\n3 1 0\n0 0 0\n1 0 0\n";
  EXPECT_EQ(complaint("a.off", head + "0 1 0\n3 0 1 2\n"), "");
  EXPECT_EQ(complaint("a.off", head + "0 nan 0\n3 0 1 2\n"),
            "line 6: found 'nan', expected y of vertex 2 of 3, a finite number");
  EXPECT_EQ(complaint("a.off", head + "0 1 0\n3 0 1 3\n"),
            "line 7: found '3', expected a vertex of face 0 of 1, from 0 to 2");
  EXPECT_EQ(complaint("a.off", head + "0 1 0\n3 0 1 -1\n"),
            "line 7: found '-1', expected a vertex of face 0 of 1, from 0 to 2");
  EXPECT_EQ(complaint("a.off", head + "0 1 0\n3 0 1"),
            "line 7: the file ends where a vertex of face 0 of 1, from 0 to 2 is expected; is it truncated?");
  EXPECT_EQ(complaint("a.off", "OFF\n4000000000 1 0\n0 0 0\n"),
            "line 3: the file ends where x of vertex 1 of 4000000000, a finite number is expected; is it truncated?");
}

TEST(SurfaceComplaint, TellsTruncatedStlFiles) {
  std::string binary(80, ' ');
  binary += std::string("\2\0\0\0", 4) + std::string(100, '\0');
  EXPECT_EQ(complaint("a.stl", binary), "");
  EXPECT_EQ(complaint("a.stl", binary.substr(0, 140)),
            "the file has 140 bytes, its 2 triangles take 184; is it truncated?");
  EXPECT_THAT(complaint("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\n"),
              testing::HasSubstr("without 'endsolid'"));
}

}  // namespace
}  // namespace signorini
