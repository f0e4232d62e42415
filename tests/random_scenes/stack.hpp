#pragma once
#include "block_file.hpp"

namespace signorini::test {

struct Material {
  double young = 1, poisson = 0.3;
  int order = 1;
};

/// Solids are closed surfaces that the program fills with a mesh of its own.
enum class Kind { files, shapes, symmetric, axisymmetric, solids };

/// Blocks on each other, from the lowest to the highest: the lowest is held from below or stands on a rigid plane, the
/// highest is moved, and those between lie between. All are held sideways at their left (and front) sides.
template <int D>
struct Stack {
  Kind kind = Kind::files;
  std::vector<Block<D>> blocks;
  std::vector<Material> materials;
  std::vector<double> gaps;  ///< below each; of the lowest one only where it stands on a plane
  std::string plane;         ///< of 2D: strain, stress
  bool on_plane = false;
  double friction = 0;
  Point<D> motion{};       ///< of the top at t = 1
  bool only_down = false;  ///< it is free sideways, but for where its sides are held
  int steps = 1, refinements = 0;

  bool in_strain() const { return D == 2 && kind != Kind::axisymmetric && plane == "strain"; }
};

/// How it is solved, which is not to change what is found.
struct Way {
  bool reversed = false;  ///< the bodies stand in the file from the highest to the lowest
  bool swapped = false;   ///< pairs are named from above
  std::string start = "nested", hierarchy = "auto";
  int threads = 1;
  Form form = Form::shape;

  /// @param is_plain seen as it is: then files may be shapes as well
  static Way any(Random& random, Kind kind, bool is_plain) {
    Way out = of(random, kind);
    if (is_plain && kind == Kind::files && random.chance(0.2)) out.form = Form::shape;
    out.reversed = random.chance(0.5), out.swapped = random.chance(0.5);
    if (random.chance(0.3)) out.start = "zero";
    if (random.chance(0.2)) out.hierarchy = "matrix";
    if (random.chance(0.2)) out.threads = 2;
    return out;
  }
  /// As the scene says, from some form of file where it is of files.
  static Way of(Random& random, Kind kind) {
    Way out;
    if (kind == Kind::files) out.form = mesh_forms[random.below(std::size(mesh_forms))];
    if (kind == Kind::solids) out.form = surface_forms[random.below(std::size(surface_forms))];
    return out;
  }
};

inline std::string solver_text(const Way& way) {
  return fmt::format("[solver]\nstart = \"{}\"\nhierarchy = \"{}\"\nthreads = {}\n", way.start, way.hierarchy,
                     way.threads);
}

/// The tables of a stack. Meshes are written into the folder where its kind is files.
template <int D>
class StackText {
 public:
  StackText(const Stack<D>& stack, const View<D>& view, const Way& way, std::filesystem::path folder)
      : stack_(stack), view_(view), way_(way), folder_(std::move(folder)) {}

  std::string text() const {
    const int n = static_cast<int>(stack_.blocks.size());
    std::string out = "title = \"random\"\n";
    for (int k = 0; k < n; ++k) out += body(way_.reversed ? n - 1 - k : k);
    for (int k = 0; k < n; ++k) out += sides(k);
    if (stack_.on_plane)
      out += rigid_plane();
    else
      out += fix(0, "bottom", stack_.only_down ? along_normal("0") : vector_value({}));
    out += fix(n - 1, "top", top_value());
    for (int k = 1; k < n; ++k) out += pair(k);
    if (stack_.kind == Kind::symmetric) out += "[symmetry]\nx = 0\n";
    out += fmt::format("[refine]\nuniform = {}\n[steps]\ncount = {}\n", stack_.refinements, stack_.steps);
    return out + solver_text(way_);
  }

 private:
  static std::string name(int k) { return fmt::format("b{}", k); }

  std::string body(int k) const {
    const Block<D>& block = stack_.blocks[k];
    std::string out = fmt::format("[[body]]\nname = \"{}\"\n", name(k));
    if (way_.form != Form::shape) {
      const std::string file = write_block<D>(folder_, name(k), block, way_.form, view_).string();
      out += is_surface(way_.form)
                 ? fmt::format("shape = \"solid\"\nfile = \"{}\"\nsize = {:.17g}\n", file, 0.5 * view_.length)
                 : fmt::format("mesh = \"{}\"\n", file);
    } else {
      out += fmt::format("shape = \"{}\"\nfrom = {}\nto = {}\ncells = {}\n", D == 2 ? "rectangle" : "box",
                         vector_text(view_.place(block.from)), vector_text(view_.place(block.to)), block.cells);
    }
    const Material& m = stack_.materials[k];
    out += fmt::format("young = {:.17g}\npoisson = {:.17g}\norder = {}\n", m.young * view_.stress, m.poisson, m.order);
    if (stack_.kind == Kind::axisymmetric) return out + "plane = \"axisymmetric\"\n";
    return D == 2 ? out + fmt::format("plane = \"{}\"\n", stack_.plane) : out;
  }

  std::string fix(int k, const std::string& on, const std::string& value) const {
    return fmt::format("[[fix]]\nbody = \"{}\"\n{}{}", name(k), part(k, on), value);
  }
  /// The key that picks a side.
  std::string part(int k, const std::string& on, const std::string& key = "") const {
    const std::vector<std::string>& all = block_parts<D>();
    const auto side = std::ranges::find(all, on) - all.begin();
    if (is_nameless(way_.form)) return fmt::format("{}on = \"{}\"\n", key, side + 1);
    if (!is_surface(way_.form)) return fmt::format("{}on = \"{}\"\n", key, on);
    const Block<D>& block = stack_.blocks[k];
    const double at = view_.place(side % 2 ? block.to : block.from)[side / 2];
    return fmt::format("{}where = \"abs({} - ({:.17g})) < {:.17g}\"\n", key, "xyz"[side / 2], at, 1e-6 * view_.length);
  }
  static std::string along_normal(const std::string& value) {
    return fmt::format("frame = \"normal\"\nvalue = [{}, \"free\"{}]\n", value, D == 3 ? ", \"free\"" : "");
  }
  std::string vector_value(const Point<D>& way) const {
    std::string out;
    for (const double c : view_.way(way)) out += fmt::format("{}\"{:.17g}*t\"", out.empty() ? "" : ", ", c);
    return "value = [" + out + "]\n";
  }
  std::string top_value() const {
    if (!stack_.only_down) return vector_value(stack_.motion);
    return along_normal(fmt::format("\"{:.17g}*t\"", stack_.motion[D - 1] * view_.length));
  }

  std::string sides(int k) const {
    std::string out;
    const bool all =
        !stack_.only_down && (k + 1 == static_cast<int>(stack_.blocks.size()) || (k == 0 && !stack_.on_plane));
    if (all) return "";  // its top or bottom is held in all directions
    if (stack_.kind != Kind::symmetric && stack_.kind != Kind::axisymmetric) out += fix(k, "left", along_normal("0"));
    if (D == 3) out += fix(k, "front", along_normal("0"));
    return out;
  }

  std::string rigid_plane() const {
    Point<D> foot = stack_.blocks[0].from, up{};
    foot[D - 1] -= stack_.gaps[0];
    up[D - 1] = 1;
    return fmt::format("[[obstacle]]\ntype = \"{}\"\n{}body = \"b0\"\n{}shape = \"plane\"\npoint = {}\nnormal = {}\n",
                       stack_.friction > 0 ? "coulomb" : "contact", friction(), part(0, "bottom"),
                       vector_text(view_.place(foot)), vector_text(view_.direction(up)));
  }

  std::string friction() const {
    return stack_.friction > 0 ? fmt::format("friction = {:.17g}\n", stack_.friction) : "";
  }

  std::string pair(int k) const {
    const int low = k - 1, body = way_.swapped ? k : low, other = way_.swapped ? low : k;
    const auto facing = [&](int b, const char* key) { return part(b, b == k ? "bottom" : "top", key); };
    return fmt::format("[[obstacle]]\ntype = \"{}\"\n{}body = \"{}\"\n{}other = \"{}\"\n{}",
                       stack_.friction > 0 ? "elastic_coulomb" : "elastic",
                       stack_.friction > 0 ? friction() : "renew = false\n", name(body), facing(body, ""), name(other),
                       facing(other, "other_"));
  }

  const Stack<D>& stack_;
  const View<D>& view_;
  const Way& way_;
  std::filesystem::path folder_;
};

}  // namespace signorini::test
