#pragma once
#include <array>
#include <string>

namespace signorini {

/// Of an orthotropic material, along its own directions 1, 2, 3: Young's moduli E1, E2, E3, Poisson's ratios nu12,
/// nu13, nu23 (a pull along 1 shortens direction 2 by nu12 times what it lengthens direction 1) and shear moduli G12,
/// G13, G23.
using EngineeringConstants = std::array<double, 9>;

/// What is wrong with constants that are those of no material: a modulus that is not positive, or a strain that would
/// not need energy. Empty: nothing.
std::string complaint(const EngineeringConstants& constants);

/// Row-major, stress = C strain along the material's directions, both as 11, 22, 33, 12, 23, 13; shear strains are
/// those of engineers, twice the tensor's. Of constants without complaint.
std::array<double, 36> stiffness_of(const EngineeringConstants& constants);

/// Young's modulus and Poisson's ratio.
struct IsotropicConstants {
  double young, poisson;
};

/// Of the isotropic material that stands for it where single numbers have to do: of the mean compliance over all
/// orientations (Reuss; Hill, Proc. Phys. Soc. A 65, 1952).
IsotropicConstants mean_constants(const EngineeringConstants& constants);

}  // namespace signorini
