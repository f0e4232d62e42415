#pragma once
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/fem/model/orthotropy.hpp"
#include "core/input/field.hpp"
#include "core/mortar/pairing.hpp"
#include "core/sdk/obstacle.hpp"
#include "core/sdk/settings.hpp"

namespace signorini {

/// Boundary faces picked by a named part, or by an expression that is nonzero at all vertices of the face, on the
/// coarsest mesh. Or the edge (2D: the points) that two parts have in common, or a vertex.
struct Selection {
  std::optional<std::string> part;
  std::optional<Field> where;
  std::string origin;                     ///< for messages: "scene.toml:12: fix.0"
  std::optional<std::string> other = {};  ///< the second part
  std::vector<double> at = {};            ///< a point, of which the vertex is near; empty: none

  bool picks_faces() const { return !other && at.empty(); }
};

/// Across a plane mesh. Axisymmetric: it is the meridian (r, z) of a body of revolution.
enum class Plane { strain, stress, axisymmetric };
enum class Frame { global, normal, cylindrical };

/// What components of a condition are along, see directions().
template <int B>
struct LocalFrame {
  LocalFrame(Frame of = Frame::global) : kind(of) {}  // NOLINT: most have no axis

  Frame kind;
  std::array<double, B> center{}, axis{};  ///< of a cylindrical one: a point of the axis, and in 3D its direction

  bool operator==(const LocalFrame&) const = default;
};

/// An orthotropic material.
template <int B>
struct Orthotropy {
  EngineeringConstants constants;
  std::array<std::array<double, 3>, 3> axes;  ///< unit vectors in space: its directions 1, 2, 3; 3 is across the plane
  LocalFrame<B> frame = {};                   ///< a cylindrical one gives the directions in place of these

  bool operator==(const Orthotropy&) const = default;
};

/// Of nearly incompressible material: whether its pressure has unknowns of its own, see
/// core/fem/incompressible/pressure_space.hpp. Linear: continuous within a material, with an unknown per corner of an
/// element; constant: one per element.
enum class Pressure { none, linear, constant };

/// Dirichlet condition: one field per component, empty where the component is free.
template <int B>
struct Fix {
  Selection on;
  std::array<std::optional<Field>, B> value;
  LocalFrame<B> frame = {};
};

/// What a load is in total, numbers or functions of t.
template <int B>
struct Resultant {
  std::array<Field, B> force;
  std::vector<Field> torque;  ///< its moment: B = 3 about each axis, B = 2 about z; empty: of the force alone
  std::optional<std::array<double, B>> about;  ///< the point that the moment is about; empty: the centroid
  std::string origin;
};

/// Of a pressure that acts only where its faces touch nothing.
struct JointSource {
  std::optional<Selection> from;  ///< a part that it comes from: it acts where openings are connected with that
};

/// A traction or flux (with `on`), or a body force or source (without).
template <int B>
struct Load {
  std::optional<Selection> on;
  std::array<Field, B> value;
  std::array<Index, 2> regions = {-1, -1};  ///< of a body force: the first and the last that it acts in; -1: all
  std::optional<Resultant<B>> total = {};   ///< in place of `value`: see distributed()
  /// Of a traction: see JointPressure, which knows where it acts; load_vector() leaves it out. Nothing: everywhere.
  std::optional<JointSource> where_open = {};
};

/// A traction -k u on faces: an elastic foundation, or a spring.
template <int B>
struct Spring {
  Selection on;
  std::array<Field, B> stiffness;  ///< along each component of the frame, not negative
  bool total = false;              ///< they are those of all the faces, else per measure
  LocalFrame<B> frame = {};
};

/// Faces that move as a rigid body does: by a displacement of one point and a rotation about it. Each component is
/// prescribed, or free and moved by a force, a torque.
template <int B>
struct RigidPart {
  static constexpr int rotations = B * (B - 1) / 2;  ///< about z in 2D

  Selection on;
  std::optional<std::array<double, B>> point;  ///< nothing: the centroid of the faces, each with its undeformed area
  std::array<std::optional<Field>, B> displacement;
  std::array<std::optional<Field>, rotations> rotation;  ///< in radians
  std::array<Field, B> force;
  std::array<Field, rotations> torque;
};

/// Of two bodies that may touch each other the one that is to be the slave.
enum class Slave { automatic, body, other };

/// Of a tie across the shank of a bolt: its sides are pulled into each other along the normal, all by the same length,
/// by which the bolt is shorter then.
struct Pretension {
  Field force;                   ///< in total, of the whole; a function of t
  std::optional<double> locked;  ///< the length that is kept whatever the force is then; nothing: the force acts
  std::string origin;
};

/// An obstacle and the vertices it may touch: those of the selected faces, or all when `on` is empty.
template <int B>
struct ObstacleTerm {
  std::shared_ptr<const Obstacle<B>> obstacle;
  std::optional<Selection> on;
  std::string origin;
  /// Of a rigid obstacle: bounds at a vertex are its distances to this shape.
  std::shared_ptr<const DistanceFunction> shape = {};
  /// The same where it was at the last load step; null where that is not known, or it does not move.
  std::shared_ptr<const DistanceFunction> shape_before = {};
  /// Where it has any: they know what the obstacle wrongly asked of them.
  std::shared_ptr<const Settings> settings = {};
  /// Of an obstacle between two bodies the faces of the second one, the master; those of `on` are the slave's.
  std::optional<Selection> other = {};
  /// Of these two which one shall be the slave, see choose_slaves(), and how faces find each other.
  Slave slave = Slave::body;
  Pairing pairing = Pairing::normal;
  bool resolve = false;  ///< they may overlap however deep at the start
  bool renew = true;     ///< bodies, or a body and a rigid obstacle, are looked at where the solution takes them
  double adjust = 0;     ///< gaps and overlaps of bodies that may part, at the start, up to this count as none
  /// Of bodies that are tied to each other how far apart they may be at the start, see Tying; nothing: they may part.
  std::optional<double> tied = {};
  std::optional<Pretension> pretension = {};  ///< of a tie
  /// Of a rigid obstacle: conditions of contact are linear about the body displaced by this.
  std::array<double, B> moved = {};
};

/// The boundary value problem, free of any mesh. B = 1: diffusion; B = D: elasticity.
template <int B>
struct Model {
  Field diffusion = 1;           ///< B = 1
  Field young = 1, poisson = 0;  ///< B > 1
  /// B > 1: per region, from `first_region` on; null: the material is isotropic, else young and poisson stand for it
  /// where one number has to do. Empty: all are isotropic.
  std::vector<std::shared_ptr<const Orthotropy<B>>> orthotropic;
  Index first_region = -1;
  Field expansion = 0;                 ///< B > 1: strain per change of temperature, in all directions
  Field temperature = 0;               ///< B > 1: its change, from where the body has no stress
  Plane plane = Plane::strain;         ///< D = 2; of B = 1 only whether it is axisymmetric
  Pressure pressure = Pressure::none;  ///< B > 1
  std::vector<Fix<B>> fixes;
  std::vector<Load<B>> loads;
  std::vector<Spring<B>> springs;
  std::vector<ObstacleTerm<B>> obstacles;
  std::vector<RigidPart<B>> rigid;
  double t = 1;                 ///< step parameter
  bool follows = false;         ///< another load step: friction counts from the solution of the last one
  std::string origin = "body";  ///< of the body, for messages: "scene.toml:3: body.0"
};

/// Whether parts of the model may touch each other.
template <int B>
bool is_paired(const Model<B>& model) {
  return std::ranges::any_of(model.obstacles, [](const ObstacleTerm<B>& term) { return term.other.has_value(); });
}

/// Whether some unknowns are no displacements.
template <int B>
bool changes_unknowns(const Model<B>& model) {
  return is_paired(model) || !model.rigid.empty();
}

}  // namespace signorini
