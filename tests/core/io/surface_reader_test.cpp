#include "core/io/surface_reader.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "mesh_samples.hpp"
#include "tests/core/mesh/mesh_checks.hpp"

namespace signorini {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

PolygonSoup parse(const std::string& content, const std::string& format) {
  return parse_surface(content, format, "a." + format);
}

std::string complaint(const std::string& content, const std::string& format) {
  return test::input_error_of([&] { parse(content, format); });
}

/// A square and a triangle beside it.
const std::vector<Point<3>> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0.5, -0.25}};
const std::vector<std::vector<std::size_t>> faces{{0, 1, 2, 3}, {1, 4, 2}};

void expect_sample(const PolygonSoup& soup) {
  EXPECT_EQ(soup.points, points);
  EXPECT_EQ(soup.faces, faces);
}

void expect_sample(const std::string& content, const std::string& format) {
  SCOPED_TRACE(content);
  expect_sample(parse(content, format));
}

std::string replaced(std::string text, const std::string& old, const std::string& fresh) {
  for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += fresh.size())
    text.replace(at, old.size(), fresh);
  return text;
}

const std::string off = "OFF\n5 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0.5 -0.25\n4 0 1 2 3\n3 1 4 2\n";
const std::string obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0.5 -0.25\nf 1 2 3 4\nf 2 5 3\n";

TEST(SurfaceReader, LineEndsCommentsAndPaddingAreNoMatter) {
  for (const auto& [text, format] : {std::pair{off, "off"}, {obj, "obj"}}) {
    expect_sample(text, format);
    expect_sample(replaced(text, "\n", "\r\n"), format);
    expect_sample(replaced(text, "\n", "\r"), format);
    expect_sample(replaced(text, "\n", "  # a 3\n\n"), format);
    expect_sample(replaced(text, " ", "\t "), format);
    expect_sample("\xEF\xBB\xBF" + text + std::string("\0\0\n", 3), format);
    expect_sample(text.substr(0, text.size() - 1) + "\x1a", format);
  }
}

TEST(SurfaceReader, OffFilesMayHoldMorePerVertexAndFace) {
  expect_sample(replaced(off, "5 2 0", "5 2"), "off");
  expect_sample(replaced(off, "OFF\n", ""), "off");
  expect_sample(replaced(off, "OFF\n", "OFF "), "off");
  expect_sample(replaced(off, " 0\n", " 0 255 0 0 1\n"), "off");
  expect_sample(replaced(replaced(off, "OFF", "STCNOFF"), "0 0 0\n", "0 0 0 0 0 1 0.5 0.5 0.5 1 0 0\n"), "off");
  expect_sample(replaced(off, "3 1 4 2", "3 1 4\n2 0.5 0.5 0.5"), "off");
  std::string homogeneous = "4OFF\n5 2 0\n0 0 0 1\n2 0 0 2\n1 1 0 1\n0 1 0 1\n-4 -1 0.5 -2\n4 0 1 2 3\n3 1 4 2\n";
  expect_sample(homogeneous, "off");
  EXPECT_THAT(complaint(replaced(homogeneous, "1 1 0 1\n", "1 1 0 0\n"), "off"),
              HasSubstr("line 5: vertex 2 of 5 lies"));
  EXPECT_THAT(complaint(replaced(off, "OFF", "OFF BINARY"), "off"), HasSubstr("line 1: a binary OFF file"));
}

TEST(SurfaceReader, ObjFilesMayHoldWhatIsNoFace) {
  expect_sample("mtllib a.mtl\no c\ng h k\ns off\nusemtl m#1\n" + obj + "vt 0 0\nvn 0 0 1\nl 1 4\np 1\ncstype bezier\n",
                "obj");
  expect_sample(replaced(obj, " 0\n", " 0 0.1 0.2 0.3\n"), "obj");
  expect_sample(replaced(obj, " 0\n", " +0.0e0 1.0\n"), "obj");
  expect_sample(replaced(obj, "f 2 5 3", "f 2/1 5/1/7 3//2"), "obj");
  expect_sample(replaced(obj, "f 2 5 3", "f -4 -1 -3"), "obj");
  expect_sample(replaced(obj, "f 2 5 3", "f 2 \\\n5 \\\r\n 3"), "obj");
  expect_sample("f 1 2 3 4\n" + replaced(obj, "f 1 2 3 4\n", ""), "obj");
}

TEST(SurfaceReader, ObjFilesNameTheirLine) {
  EXPECT_THAT(complaint(replaced(obj, "2 5 3", "2 5 6"), "obj"),
              HasSubstr("line 7: face 1 has vertex 6, expected one of the 5"));
  EXPECT_THAT(complaint(replaced(obj, "2 5 3", "2 5 0"), "obj"),
              HasSubstr("line 7: found '0', expected a vertex such as"));
  EXPECT_THAT(complaint(replaced(obj, "2 5 3", "2 5 -6"), "obj"), HasSubstr("line 7: found '-6'"));
  EXPECT_THAT(complaint(replaced(obj, "f 2 5 3", "f 2 5"), "obj"), HasSubstr("line 7: face 1 has 2 vertices"));
  EXPECT_THAT(complaint(replaced(obj, "v 1 1 0", "v 1 1"), "obj"),
              HasSubstr("line 3: the line ends where z of vertex 3"));
  EXPECT_THAT(complaint(replaced(obj, "f 2", "ff 2"), "obj"), HasSubstr("line 7: found 'ff', expected a statement"));
  EXPECT_THAT(complaint(obj + std::string("\0v", 2), "obj"), HasSubstr("line 8: found '\\x00v'"));
  EXPECT_THAT(complaint("v 0 0 0\n", "obj"), HasSubstr("no faces"));
}

TEST(SurfaceReader, OffFilesNameTheirLine) {
  EXPECT_THAT(complaint(replaced(off, "0.5", "nan"), "off"),
              HasSubstr("line 7: found 'nan', expected y of vertex 4 of 5, a finite number"));
  EXPECT_THAT(complaint(replaced(off, "1 4 2", "1 4 5"), "off"),
              HasSubstr("line 9: found '5', expected a vertex of face 1 of 2, from 0 to 4"));
  EXPECT_THAT(
      complaint(replaced(off, "3 1 4 2\n", "3 1 4\n"), "off"),
      HasSubstr("line 9: the file ends where a vertex of face 1 of 2, from 0 to 4 is expected; is it truncated?"));
  EXPECT_THAT(complaint("OFF\n4000000000 1 0\n0 0 0\n", "off"), HasSubstr("bytes of the file can hold"));
  EXPECT_THAT(complaint("OFF\n-4 1 0\n0 0 0\n", "off"), HasSubstr("found '-4'"));
}

TEST(SurfaceReader, StlFilesAreTextOrBinary) {
  const std::string text =
      "solid a facet\nfacet normal 0 0 nan\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
      "endsolid a\nSOLID\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 1\nVERTEX 1 0 1\nVERTEX 0 1 1\nENDLOOP\nENDFACET\n"
      "ENDSOLID";
  EXPECT_THAT(parse(text, "stl").faces, ElementsAre(ElementsAre(0, 1, 2), ElementsAre(3, 4, 5)));
  EXPECT_THAT(complaint(text.substr(0, text.size() - 8), "stl"), HasSubstr("the file ends without 'endsolid'"));
  EXPECT_THAT(complaint(replaced(text, "vertex 1 0 0\n", ""), "stl"), HasSubstr("line 6: face 0 has 2 vertices"));
  EXPECT_THAT(complaint(replaced(text, "ENDLOOP", "ENDLOP"), "stl"), HasSubstr("line 16: found 'ENDLOP', expected"));
  test::ByteWriter bytes;
  bytes.out = "solid in the name of a binary file" + std::string(46, ' ');
  bytes.add<std::uint32_t>(1);
  for (int k = 0; k < 12; ++k) bytes.add<float>(static_cast<float>(k));
  bytes.add<std::uint16_t>(0);
  EXPECT_THAT(parse(bytes.out, "stl").points, ElementsAre(Point<3>{3, 4, 5}, Point<3>{6, 7, 8}, Point<3>{9, 10, 11}));
  EXPECT_EQ(parse(bytes.out + std::string(7, '\0'), "stl").faces.size(), 1u);
  EXPECT_THAT(complaint(bytes.out.substr(0, 100), "stl"),
              HasSubstr("the file has 100 bytes, its 1 triangles take 134; is it truncated?"));
}

/// The sample with properties and elements that no surface needs.
std::string ply(const std::string& format) {
  test::ByteWriter out(format == "binary_big_endian");
  out.out =
      "ply\nformat " + format +
      " 1.0\ncomment property float x\nelement vertex 5\nproperty float x\nproperty double y\nproperty uchar red\n"
      "property float32 z\nproperty list uchar short more\nelement edge 1\nproperty int vertex1\nelement face 2\n"
      "property uint8 flag\nproperty list uchar int vertex_indices\nelement empty 3\nend_header\n";
  const bool text = format == "ascii";
  const auto put = [&]<class T>(T value) {
    if (text)
      out.out += fmt::format("{} ", static_cast<double>(value));
    else
      out.add<T>(value);
  };
  for (const Point<3>& p : points) {
    put(static_cast<float>(p[0]));
    put(p[1]);
    put(std::uint8_t{255});
    put(static_cast<float>(p[2]));
    put(std::uint8_t{2});
    put(std::int16_t{-7});
    put(std::int16_t{8});
    if (text) out.out += '\n';
  }
  put(std::int32_t{0});
  for (const auto& face : faces) {
    put(std::uint8_t{1});
    put(static_cast<std::uint8_t>(face.size()));
    for (const std::size_t v : face) put(static_cast<std::int32_t>(v));
    if (text) out.out += '\n';
  }
  return out.out;
}

TEST(SurfaceReader, PlyFilesOfAllKindsAgree) {
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    SCOPED_TRACE(format);
    expect_sample(parse(ply(format), "ply"));
    expect_sample(parse(replaced(ply(format), "vertex_indices", "vertex_index"), "ply"));
  }
  expect_sample(replaced(ply("ascii"), "\n", "\r\n"), "ply");
}

TEST(SurfaceReader, PlyFilesNameWhatIsWrong) {
  const std::string good = ply("ascii");
  EXPECT_THAT(complaint("ply\nformat ascii 1.0\nproperty float x\nelement face 1\nproperty list uchar int "
                        "vertex_indices\nend_header\n3 0 1 2\n",
                        "ply"),
              HasSubstr("line 3: a property before any element"));
  EXPECT_THAT(complaint(replaced(good, "property double y", "property list uchar double y"), "ply"),
              HasSubstr("no property y"));
  EXPECT_THAT(complaint(replaced(good, "element vertex 5", "element vertex 5000"), "ply"), HasSubstr("can hold"));
  EXPECT_THAT(complaint(replaced(good, "element vertex 5", "element vertex -5"), "ply"),
              HasSubstr("line 4: found '-5'"));
  EXPECT_THAT(complaint(replaced(good, "float32", "float31"), "ply"),
              HasSubstr("line 8: found 'float31', expected a type"));
  EXPECT_THAT(complaint(replaced(good, "format ascii 1.0\n", ""), "ply"), HasSubstr("no line 'format'"));
  EXPECT_THAT(complaint(replaced(good, "end_header", "end"), "ply"), HasSubstr("found 'end'"));
  EXPECT_THAT(complaint(replaced(good, "1 3 1 4 2", "1 3 1 4 5"), "ply"),
              HasSubstr("face 1 of 2 has vertex 5, expected 0 to 4"));
  EXPECT_THAT(complaint(replaced(good, "1 3 1 4 2", "1 3 1 4 -1"), "ply"), HasSubstr("found -1"));
  EXPECT_THAT(complaint(replaced(good, "1 3 1 4 2", "1 2 1 4"), "ply"), HasSubstr("face 1 has 2 vertices"));
  EXPECT_THAT(complaint(good.substr(0, 200), "ply"), HasSubstr("without 'end_header'; is it truncated?"));
}

std::vector<std::pair<std::string, std::string>> samples() {
  return {
      {off, "off"},
      {obj, "obj"},
      {"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n",
       "stl"},
      {ply("ascii"), "ply"},
      {ply("binary_little_endian"), "ply"}};
}

/// A surface or an error, nothing else.
void expect_no_harm(const std::string& content, const std::string& format) {
  try {
    for (const PolygonSoup soup = parse(content, format); const auto& face : soup.faces)
      for (const std::size_t v : face) EXPECT_LT(v, soup.points.size());
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
  }
}

TEST(SurfaceReader, DamageAnywhereDoesNoHarm) {
  for (const auto& [content, format] : samples())
    for (std::size_t i = 0; i < content.size(); ++i) {
      expect_no_harm(content.substr(0, i), format);
      for (const char damage : {'\0', '\xff', '9', '-', ' ', '\n'}) {
        std::string damaged = content;
        damaged[i] = damage;
        expect_no_harm(damaged, format);
      }
      const std::size_t end = content.find('\n', i);  // lines that are missing, or there twice
      if (end == std::string::npos) continue;
      expect_no_harm(std::string(content).erase(i, end + 1 - i), format);
      expect_no_harm(std::string(content).insert(i, content.substr(i, end + 1 - i)), format);
    }
}

TEST(SurfaceReader, TheNameTellsTheFormat) {
  EXPECT_THAT(complaint(off, "xyz"), HasSubstr("expected OFF, OBJ, STL or PLY"));
  EXPECT_THAT(test::input_error_of([] { read_surface("/none.off"); }), HasSubstr("/none.off: no such surface file"));
}

}  // namespace
}  // namespace signorini
