#include "stockwork/rock/random_field.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"
#include "stockwork/base/scrambled.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace stockwork
{
using namespace dealii;

namespace
{
/// A number mixed into another.
std::uint64_t mixed(const std::uint64_t state, const std::uint64_t number)
{
  return scrambled(state + scrambling_step + number);
}


/// Between 0 and 1, neither of them.
double uniform_of(const std::uint64_t key)
{
  return (static_cast<double>(key >> 11) + 0.5) * 0x1p-53;
}


/// Below, the likeliest value is nothing, and places of rock are many powers of ten apart.
constexpr double least_modulus = 1.;

/// Cells per correlation length.
constexpr double fewest_cells = 2., most_cells = 5.;
} // namespace


const char *RandomField::name(const Property property)
{
  constexpr const char *names[n_properties] = {"Young modulus", "tensile strength",
                                               "critical energy release rate", "permeability"};
  return names[property];
}


void RandomField::declare_parameters(ParameterHandler &prm, const bool is_region)
{
  prm.enter_subsection("Random field");
  const auto text = [&](const std::string &name, const std::string &of_rock)
  {
    return is_region ? "As Rock/Random field/" + name + ", in this region only; empty: as there."
                     : of_rock;
  };
  std::string names;
  for (unsigned int p = 0; p < n_properties; ++p)
    names += name(static_cast<Property>(p)) + std::string("|");
  prm.declare_entry(
    "Properties", "", Patterns::MultipleSelection(names + "none"),
    text("Properties",
         "What varies from place to place: at each, it is the value of the deck (or the strength "
         "that the fracture model chooses) times a factor of its own. The elements take it at the "
         "centre of a cell of the mesh, which should be no larger than one of the lattice. Biot's "
         "constants do not vary with Young's modulus. Empty, or 'none': nothing does."));
  prm.declare_entry(
    "Weibull modulus", "", Quantity(dimension::number, Range{least_modulus, Range::any().max}, ""),
    text(
      "Weibull modulus",
      "m >= 1, the shape: the factor is less than x with the probability 1 - exp(-x^m). The value "
      "of the deck is the scale, which 63 % of the places do not reach; the mean is Gamma(1 + "
      "1/m) times that (0.951 at m = 10), with a coefficient of variation of about 1.2/m. "
      "Required where something varies."));
  prm.declare_entry("Lattice spacing", "", Quantity(dimension::length, Range::positive(), ""),
                    text("Lattice spacing",
                         "The factor is constant in the cells of a square or cubic lattice with "
                         "this spacing and a corner in the origin, whatever the mesh. Required "
                         "where something varies."));
  prm.declare_entry(
    "Correlation length", "", Quantity(dimension::length, Range::non_negative(), ""),
    text("Correlation length",
         "l: normal deviates at the distance r, from which the factors follow, are "
         "correlated by exp(-r^2/l^2). Two to five spacings of the lattice. Empty or "
         "0: each cell of the lattice is independent of the others."));
  prm.declare_entry("Seed", is_region ? "" : "1", Quantity(dimension::number, Range::finite(), ""),
                    text("Seed", "A whole number >= 0; another seed is another rock."));
  prm.declare_entry(
    "Independent properties", is_region ? "" : "false",
    Patterns::Selection(is_region ? "true|false|" : "true|false"),
    text("Independent properties",
         "false: all properties of a place have the same factor, so that what is soft is weak as "
         "well. true: each has one of its own."));
  prm.leave_subsection();
}


void RandomField::parse_parameters(ParameterHandler &prm,
                                   const std::string &path,
                                   const RandomField &inherited)
{
  *this = inherited;
  prm.enter_subsection("Random field");
  const auto refuse = [&](const std::string &entry, const std::string &allowed)
  { throw EntryError(path + "/Random field/" + entry, prm.get(entry), allowed); };
  if (const std::vector<std::string> chosen = split_list(prm.get("Properties")); !chosen.empty())
  {
    has = {};
    for (unsigned int p = 0; p < n_properties; ++p)
      has[p] = std::count(chosen.begin(), chosen.end(), name(static_cast<Property>(p))) > 0;
    if (chosen.size() > 1 && std::count(chosen.begin(), chosen.end(), "none") > 0)
      refuse("Properties", "either properties or 'none'");
  }
  modulus =
    get_optional_quantity(prm, "Weibull modulus", dimension::number).value_or(inherited.modulus);
  spacing =
    get_optional_quantity(prm, "Lattice spacing", dimension::length).value_or(inherited.spacing);
  length =
    get_optional_quantity(prm, "Correlation length", dimension::length).value_or(inherited.length);
  if (const auto number = get_optional_quantity(prm, "Seed", dimension::number))
  {
    if (*number < 0. || *number != std::floor(*number) || *number > 0x1p53)
      refuse("Seed", "a whole number from 0 to 2^53");
    seed = static_cast<std::uint64_t>(*number);
  }
  if (const std::string text = prm.get("Independent properties"); !text.empty())
    independent = text == "true";

  if (is_random())
  {
    const std::string why = ", for 'Properties' says that something varies";
    if (modulus == 0.)
      refuse("Weibull modulus", "a number from 1, such as 10" + why);
    if (spacing == 0.)
      refuse("Lattice spacing", "a length > 0 m, such as '1 m'" + why);
    if (length > 0. && (length < fewest_cells * spacing * (1. - 1e-9) ||
                        length > most_cells * spacing * (1. + 1e-9)))
      refuse("Correlation length", "0, or two to five spacings of the lattice (of " +
                                     stockwork::to_string(spacing, dimension::length) + ")");
  }
  set_weights();
  prm.leave_subsection();
}


void RandomField::set_weights()
{
  weights.clear();
  if (!is_random() || length == 0.)
    return;
  double squares = 0.;
  for (int i = 0; i * spacing <= 2. * length; ++i) // beyond, 3e-4 and less
  {
    weights.push_back(std::exp(-2. * std::pow(i * spacing / length, 2)));
    squares += (i == 0 ? 1. : 2.) * weights.back() * weights.back();
  }
  for (double &weight : weights)
    weight /= std::sqrt(squares);
}


bool RandomField::is_random() const
{
  return std::any_of(has.begin(), has.end(), [](const bool varies) { return varies; });
}


std::uint64_t RandomField::key(const Property property, const Indices &cell) const
{
  std::uint64_t key = mixed(mixed(0, seed), independent ? property : 0u);
  for (const std::int64_t index : cell)
    key = mixed(key, static_cast<std::uint64_t>(index));
  return key;
}


double RandomField::normal_deviate(const Property property, const Indices &cell) const
{
  // Box and Muller 1958.
  const std::uint64_t first = key(property, cell), second = mixed(first, 0);
  return std::sqrt(-2. * std::log(uniform_of(first))) * std::cos(2. * M_PI * uniform_of(second));
}


template <int dim>
double RandomField::exceedance(const Property property, const Indices &cell) const
{
  if (weights.empty())
    return uniform_of(key(property, cell));
  const int n = static_cast<int>(weights.size()) - 1, n_z = dim == 3 ? n : 0;
  double deviate = 0.;
  for (int k = -n_z; k <= n_z; ++k)
    for (int j = -n; j <= n; ++j)
      for (int i = -n; i <= n; ++i)
        deviate += weights[std::abs(i)] * weights[std::abs(j)] *
                   (dim == 3 ? weights[std::abs(k)] : 1.) *
                   normal_deviate(property, {{cell[0] + i, cell[1] + j, cell[2] + k}});
  return 0.5 * std::erfc(deviate / std::sqrt(2.));
}


template <int dim>
std::array<double, RandomField::n_properties> RandomField::factors(const Point<dim> &place) const
{
  std::array<double, n_properties> result;
  result.fill(1.);
  // Centres of large cells of the mesh may lie between cells of the lattice: round-off and all,
  // they belong to the upper one.
  Indices cell{};
  for (unsigned int d = 0; d < dim && is_random(); ++d)
    cell[d] = static_cast<std::int64_t>(std::floor(place[d] / spacing + 1e-6));
  double shared = 0.; // by all properties; 0: not drawn yet
  for (unsigned int p = 0; p < n_properties; ++p)
    if (has[p])
    {
      if (independent || shared == 0.)
        shared = std::pow(-std::log(exceedance<dim>(static_cast<Property>(p), cell)), 1. / modulus);
      result[p] = shared;
    }
  return result;
}


double RandomField::mean_factor() const
{
  return std::tgamma(1. + 1. / modulus);
}


double RandomField::deviation() const
{
  return std::sqrt(std::max(0., std::tgamma(1. + 2. / modulus) - std::pow(mean_factor(), 2)));
}


std::string RandomField::describe() const
{
  std::ostringstream text;
  bool is_first = true;
  for (unsigned int p = 0; p < n_properties; ++p)
    if (has[p])
    {
      text << (is_first ? "" : ", ") << name(static_cast<Property>(p));
      is_first = false;
    }
  text << ": Weibull, m = " << modulus << ", lattice of " << spacing << " m";
  if (length > 0.)
    text << ", correlated over " << length << " m";
  text << ", seed " << seed;
  if (independent && std::count(has.begin(), has.end(), true) > 1)
    text << ", each by itself";
  return text.str();
}


template std::array<double, RandomField::n_properties> RandomField::factors(const Point<2> &) const;
template std::array<double, RandomField::n_properties> RandomField::factors(const Point<3> &) const;
} // namespace stockwork
