#pragma once
#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/fem/model/model.hpp"
#include "core/geometry/body_geometry.hpp"
#include "core/geometry/geometry.hpp"
#include "core/input/field.hpp"
#include "core/input/raw.hpp"
#include "core/mesh/mesh.hpp"
#include "core/solver/options.hpp"

namespace signorini {

/// A problem as the user wrote it: validated, defaults filled in, free of meshes and plugins. Lengths, moduli and
/// forces are in the user's units.
struct Scene {
  /// Where a table and its keys were written, for messages.
  struct Source {
    std::string table;  ///< "scene.toml:12: fix.0"
    std::map<std::string, std::string, std::less<>> keys;

    /// "scene.toml:14: fix.0.value"; the table's own place when the key was not given.
    const std::string& of(std::string_view key) const;
    bool given(std::string_view key) const { return keys.find(key) != keys.end(); }
  };

  enum class Equation { elasticity, diffusion };

  /// `rectangle` (D = 2) or `box` (D = 3), cut into equal cells.
  template <int D>
  struct Block {
    Point<D> from{}, to{};
    std::array<Index, D> cells{};
  };

  struct MeshFile {
    std::filesystem::path file;
    geometry::Reading reading;
  };

  using BodyShape = std::variant<MeshFile, Block<2>, geometry::Disk, geometry::Polygon, Block<3>, geometry::Ball,
                                 geometry::Cylinder, geometry::Solid>;

  /// In place of a body's young and poisson.
  struct Orthotropic {
    EngineeringConstants constants;
    std::vector<std::vector<double>> axes;  ///< its directions 1 and 2, in 2D 1 alone; empty: x and y
    std::vector<double> center, axis;       ///< of a cylindrical frame, in place of these; empty: none
  };

  struct Body {
    std::string name;
    BodyShape shape;
    std::optional<Field> size;  ///< target edge length; for the shapes that are meshed freely
    Equation equation = Equation::elasticity;
    Field young = 1, poisson = 0;            ///< elasticity
    std::optional<Orthotropic> orthotropic;  ///< elasticity; then young and poisson stand for it
    Field expansion = 0, temperature = 0;    ///< elasticity
    Field diffusion = 1;                     ///< diffusion
    Plane plane = Plane::strain;             ///< 2D
    int order = 0;                           ///< of the elements, 1 or 2; 0: what choose_elements() takes
    bool order_chosen = false;               ///< by it, and not by the scene
    std::optional<Pressure> pressure;        ///< where material is nearly incompressible; the reader leaves none empty
    Source source;
    std::vector<Body> parts;  ///< bodies that may touch each other, as one: see driver/scene/touching_bodies.hpp

    /// Whether a table for that body is for this one, or for one of its parts.
    bool answers_to(std::string_view body) const {
      return body == name || std::ranges::any_of(parts, [&](const Body& part) { return part.name == body; });
    }
  };

  /// Of a physical group of elements, in place of the body's own. What the body's equation has no use for is empty.
  struct Material {
    std::string body, volume;
    std::optional<Field> young, poisson, diffusion, expansion;
    Source source;
  };

  /// Of a cylindrical frame; both empty for other ones.
  struct FrameAxis {
    std::vector<double> center, direction;  ///< a point, and in 3D a direction of any length
  };

  struct Fix {
    std::string body;
    Selection on;
    std::vector<std::optional<Field>> value;  ///< per component, empty where free; one entry for diffusion
    Frame frame = Frame::global;
    Source source;
    FrameAxis axis = {};
  };

  struct Load {
    std::string body;
    std::optional<Selection> on;  ///< without: a body force or source
    std::vector<Field> value;     ///< per component; one entry for diffusion; empty where one of the next is given
    Source source;
    std::optional<Field> pressure = {};
    std::vector<Field> force = {};   ///< in total, as `value`
    std::vector<Field> torque = {};  ///< in total: 3D three entries, 2D one
    std::vector<double> about = {};  ///< the point that it is about; empty: the centroid
    Frame frame = Frame::global;     ///< of `value`
    FrameAxis axis = {};
    bool where_open = false;  ///< `pressure` acts only where the faces touch nothing
    std::string from = {};    ///< then a part that it comes from; empty: it acts wherever that is

    bool is_total() const { return !force.empty() || !torque.empty(); }
  };

  /// A spring, or an elastic foundation.
  struct Spring {
    std::string body;
    Selection on;
    std::vector<Field> stiffness;  ///< one for all directions, or one per component
    bool total = false;            ///< of all the faces, else per area
    Frame frame = Frame::global;
    Source source;
    FrameAxis axis = {};
  };

  /// Faces that move as a rigid body. What is not given is empty: free components, and no force.
  struct Rigid {
    std::string body;
    Selection on;
    std::vector<double> point;
    std::vector<std::optional<Field>> displacement, rotation;  ///< per component, empty where free
    std::vector<Field> force, torque;
    Source source;
  };

  /// Rigid obstacles. Fields are evaluated at the vertex that asks for its distance, with its normal and the step
  /// parameter; vectors have an entry per dimension and need not have unit length.
  struct PlaneShape {
    std::vector<Field> point, normal;
  };
  struct SphereShape {
    std::vector<Field> center;
    Field radius;
    bool inside = false;  ///< the body lies inside the sphere
  };
  struct CylinderShape {
    std::vector<Field> center, axis;
    Field radius;
  };
  struct SurfaceShape {
    std::filesystem::path file;
    std::optional<double> crease = geometry::default_crease;  ///< radians; nothing: facets
  };
  struct ExpressionShape {
    Field distance;
    std::vector<Field> normal;  ///< empty: the gradient of the distance
  };
  using ObstacleShape = std::variant<PlaneShape, SphereShape, CylinderShape, SurfaceShape, ExpressionShape>;

  /// Quasi-static steps. Nothing has happened yet at t = 0.
  struct Steps {
    std::vector<double> at{1.0};  ///< the values of t, ascending, the last one 1
    int halvings = 4;             ///< how often a step that fails is cut in two
    Source source;

    int count() const { return static_cast<int>(at.size()); }
  };

  struct Obstacle {
    std::string type;  ///< the id of an obstacle plugin
    std::string body;
    std::optional<Selection> on;
    std::string other;  ///< the second body; empty: it acts on one
    std::optional<Selection> other_on;
    Slave slave = Slave::automatic;
    Pairing pairing = Pairing::normal;
    bool resolve = false;             ///< however deep the two overlap at the start
    bool renew = true;                ///< pairs faces anew where the last step has moved them to
    double adjust = 0;                ///< gaps and overlaps at the start up to this count as none
    std::optional<Field> pretension;  ///< of a tie: the force of a bolt that is cut there
    std::optional<double> lock_at;    ///< t up to which it acts; nothing: the first of several steps
    std::string shape_name;           ///< the key `shape`; empty without
    std::optional<ObstacleShape> shape;
    RawTable options;  ///< every other key: for the plugin's own OptionSpecs to validate
    Source source;

    /// Whether the bolt keeps its length in a step to t.
    bool locked(const Steps& steps, double t) const;
    /// The core's keys that this obstacle may have, for suggestions beside the plugin's own.
    std::vector<std::string> core_keys() const;
  };

  /// Obstacles between bodies that are found by their distance: see driver/scene/found_pairs.hpp.
  struct Contact {
    std::vector<std::string> between;  ///< bodies; empty: all that are elastic
    std::optional<RawValue> friction;  ///< what the obstacles say of it
    std::optional<double> reach;       ///< surfaces no farther apart are a pair; nothing: an element
    double adjust = 0;
    Pairing pairing = Pairing::normal;
    bool resolve = false, renew = true;
    Source source;
  };

  struct Solver : SolverOptions {
    std::string start = "nested";    ///< nested or zero
    bool algebraic = true;           ///< levels chosen by the matrix below a large coarsest mesh
    std::string bodies = "jumps";    ///< that touch each other: jumps or dirichlet-neumann
    std::string hierarchy = "auto";  ///< coarser levels: meshes, matrix (all algebraic), or auto: the latter where
                                     ///< cells are stretched
    std::string estimate = "false";  ///< of the error of the mesh: false, true, auto, cheap or an estimator's id
    Source source;
  };

  struct Refine {
    int uniform = 0;
    Source source;
    bool adaptive = false;    ///< refine where the error is, until one of the following
    double tolerance = 0.01;  ///< of the upper bound of the energy error, or of the goal's error, relative
    int max_unknowns = 1000000;
    int max_steps = 30;  ///< meshes beside the first one
    double max_seconds = 3600;
    std::string goal = "energy";  ///< what it is for: energy, force, peak_pressure or "probe NAME"

    bool is_for_energy() const { return goal == "energy"; }
    /// The name in "probe NAME"; empty: another goal.
    std::string goal_probe() const;
  };

  /// All bodies are symmetric about these planes, and the part on one side is meshed.
  struct Symmetry {
    std::vector<Mirror> planes;
    Source source;
  };

  struct Probe {
    std::string name, body;
    std::vector<double> at;
    Source source;
  };

  struct Output {
    bool vtu = true, pictures = true, convergence = true;
  };

  std::filesystem::path file;  ///< as the user named it
  std::string name;            ///< the file's name without folder and ending
  std::string title;
  int dimension = 0;  ///< 2 or 3 by the bodies' shapes; 0 when only mesh files tell
  std::vector<Body> bodies;
  std::vector<Material> materials;
  std::vector<Fix> fixes;
  std::vector<Load> loads;
  std::vector<Spring> springs;
  std::vector<Rigid> rigids;
  std::vector<Obstacle> obstacles;
  std::optional<Contact> contact;  ///< nothing: none are found, or all are among the obstacles
  Solver solver;
  Refine refine;
  Symmetry symmetry;
  Steps steps;
  std::vector<Probe> probes;
  std::vector<std::filesystem::path> plugin_path;  ///< absolute, or relative as the scene's file is
  Output output;

  /// The body of that name; it exists, the reader has checked it.
  const Body& body(std::string_view body_name) const;
  /// Whether `contact` looks for obstacles of that body.
  bool looks_for_pairs(const Body& body) const;
  /// The id of the estimator of the error that `solver.estimate` and `refine.adaptive` ask for: "certificate" of what
  /// asks for bounds, "recovery" where goals other than the energy do not need these; empty: none.
  std::string estimator() const;
};

/// Reads and validates a scene. Errors are Error(Exit::input) naming file and line, key, what was found, what was
/// expected and the nearest valid name; file names in it are relative to its folder.
/// @param overrides "refine.uniform=3": a dotted path and a TOML value (or a bare text), as `--set` takes them;
///   errors in them begin with "--set ASSIGNMENT"
Scene read_scene(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The same for a scene held in memory.
/// @param name stands for the file in messages
/// @param folder that file names are relative to
Scene parse_scene(std::string_view text, const std::string& name, const std::filesystem::path& folder,
                  std::span<const std::string> overrides = {});

/// Checks everything that has one entry per dimension (values, points, normals) and what only makes sense in one of
/// them. The reader does so when the dimension is known from the shape; call it once a mesh file has told it.
void check_dimension(const Scene& scene, int dimension);

/// The reference of all tables and keys in Markdown, from the table that validates them.
std::string scene_reference();

}  // namespace signorini
