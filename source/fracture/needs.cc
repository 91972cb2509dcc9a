#include "stockwork/fracture/needs.h"

#include "stockwork/base/error.h"

#include <cmath>
#include <sstream>

namespace stockwork::needs
{
namespace
{
InputError missing(const std::string &model, const std::string &what, const std::string &otherwise)
{
  return InputError("The model '" + model + "' needs " + what +
                    (otherwise.empty() ? "." : ", " + otherwise + "."));
}


std::string with(const std::string &model, const std::string &why)
{
  return " with the fracture model '" + model + "', " + why;
}
} // namespace


template <int dim>
void initial_crack(const Scene<dim> &scene, const std::string &model, const std::string &otherwise)
{
  if (scene.cracks.empty())
    throw missing(model, "an initial crack or notch (subsection Cracks)", otherwise);
}


template <int dim>
void cracks_without_proppant(const Scene<dim> &scene, const std::string &model)
{
  for (const InitialCrack<dim> &crack : scene.cracks)
    if (crack.kind == InitialCrack<dim>::Kind::propped)
      throw EntryError(crack.entry, crack.text,
                       "nothing (an empty entry)" +
                         with(model, "whose cracks have nothing between their faces; "
                                     "'cohesive_xfem' knows propped ones"));
}


template <int dim>
void open_cracks(const Scene<dim> &scene, const std::string &model)
{
  for (const InitialCrack<dim> &crack : scene.cracks)
    if (crack.kind != InitialCrack<dim>::Kind::open)
      throw EntryError(crack.entry, crack.text,
                       "nothing (an empty entry)" +
                         with(model, "whose cracks are open from the start ('Cracks/Open'); "
                                     "'cohesive_xfem' knows cohesive and propped ones"));
}


void energy_release_rate(const Rock &rock, const std::string &model, const std::string &otherwise)
{
  if (!(rock.main().energy_release_rate > 0.))
    throw missing(model,
                  "the rock's energy release rate G_c ('Rock/Critical energy release rate', or "
                  "'Rock/Fracture toughness')",
                  otherwise);
}


void energy_of_all_modes(const RockProperties &rock,
                         const std::string &model,
                         const std::string &why,
                         const std::string &path)
{
  if (!(std::abs(rock.shear_energy_release_rate - rock.energy_release_rate) >
        1e-6 * rock.energy_release_rate))
    return;
  std::ostringstream given;
  given << rock.shear_energy_release_rate << " J/m^2";
  throw EntryError(path + "/Shear energy release rate", given.str(),
                   "nothing (an empty entry), or the critical one," + with(model, why) +
                     "; 'cohesive_xfem' takes one");
}


void no_given_strength(const RockProperties &rock,
                       const std::string &model,
                       const std::string &why,
                       const std::string &path)
{
  if (std::isnan(rock.tensile_strength))
    return;
  std::ostringstream given;
  given << 1e-6 * rock.tensile_strength << " MPa";
  throw EntryError(path + "/Tensile strength", given.str(),
                   "nothing (an empty entry)" + with(model, why) + "; 'cohesive_xfem' takes one");
}


template void initial_crack(const Scene<2> &, const std::string &, const std::string &);
template void initial_crack(const Scene<3> &, const std::string &, const std::string &);
template void cracks_without_proppant(const Scene<2> &, const std::string &);
template void cracks_without_proppant(const Scene<3> &, const std::string &);
template void open_cracks(const Scene<2> &, const std::string &);
template void open_cracks(const Scene<3> &, const std::string &);
} // namespace stockwork::needs
