#pragma once
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/fem/assembly/discretize.hpp"
#include "core/fem/elements/select.hpp"

namespace signorini {

/// Of each load with Load::where_open, in their order, per node of its faces (ascending) whether it acts there.
using Wetted = std::vector<std::vector<char>>;

/// What such loads exert.
template <int B>
struct JointLoad {
  std::vector<double> force;  ///< on the nodes of both bodies, global coordinates, B each; empty: nothing
  std::vector<std::array<double, B>> total;  ///< per load of the model, on its own faces; zero for the others
  std::vector<double> area;                  ///< likewise, that it acts on
};

/// Pressure that acts only where faces touch nothing: of a fluid that enters an open joint.
template <int D, int B>
class JointPressure {
 public:
  /// Keeps references. Error(Exit::input) where the part that a pressure comes from does not meet its faces.
  JointPressure(const Nodes<D>& nodes, const Model<B>& model);

  /// There is no such load.
  bool none() const { return joints_.empty(); }
  Wetted nowhere() const;
  /// What is connected, by faces with such nodes, to nodes that are open, with JointSource::from to those of that part:
  /// nodes that are not in contact in the solution x (local coordinates), as results have it, nor tied, and those in
  /// contact on which all that presses, fluid and obstacle, is less than the pressure of the load: they open once it
  /// acts there. (At the edge of contact the pressure is that of the fluid, so that faces part and do not gape.)
  /// @param present what the loads exert in that solution
  Wetted wetted(const Discretization<B>& discretization, const std::vector<double>& x,
                const JointLoad<B>& present) const;
  /// The integrals of the pressures times the linear (quadratic) function that is 1 at the nodes that are wetted: it
  /// ends within the faces beside the contact. Nodes of a slave hand the same force to the master, by the weights of
  /// their jumps, as far as that is in front of them: where it is everywhere both sum to zero. Error(Exit::input) for
  /// faces that are a master's: what touches them is not known there.
  /// @param pairs all that there are; null: none
  JointLoad<B> load(const Wetted& wetted, const PairedBodies<B>* pairs) const;
  /// Of the first load that acts anywhere; empty: none does.
  std::string origin(const Wetted& wetted) const;

 private:
  struct Joint {
    std::size_t load;  // number in the model
    Surface<D> faces;
    std::vector<Index> sources;  // nodes that the pressure comes from; empty: from everywhere
  };

  /// What presses on nodes.
  struct Pressed {
    std::vector<char> contact;  // or tied
    std::vector<double> total;  // there, by obstacles and fluid, over the node's area
  };

  Pressed pressed(const Discretization<B>& discretization, const std::vector<double>& x,
                  const JointLoad<B>& present) const;
  std::vector<char> spread(const Joint& joint, const Pressed& pressed) const;
  std::vector<double> pressures(const Joint& joint) const;
  std::vector<double> own_force(const Joint& joint, const std::vector<char>& wetted, JointLoad<B>& out) const;
  template <class Use>
  void each_master(const MasterMeans& means, const Use& use) const;
  void hand_over(const std::vector<double>& own, const PairedBodies<B>& pairs, std::vector<double>& force) const;
  void refuse_master(const Joint& joint, const PairedBodies<B>& pairs) const;

  const Nodes<D>& nodes_;
  const Model<B>& model_;
  std::vector<Joint> joints_;
};

/// Where pressure has come to, from one solve to the next. Where what it reaches comes back to what it was it only
/// grows from then on, so that it comes to rest.
class Spreading {
 public:
  explicit Spreading(Wetted start) : now_(std::move(start)) {}

  const Wetted& now() const { return now_; }
  /// Takes what a solution with the present one says. @return whether the present one is another one now
  bool take(Wetted found);
  /// Of the present one the nodes that the last solution says are in contact.
  Index shut() const { return shut_; }

 private:
  Wetted now_;
  std::vector<Wetted> past_;
  bool grows_ = false;
  Index shut_ = 0;
};

}  // namespace signorini
