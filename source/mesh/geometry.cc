#include "mesh/geometry.h"

#include <deal.II/fe/mapping_cartesian.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "mesh/box.h"
#include "mesh/interpret_entry.h"
#include "mesh/refinement.h"
#include "mesh/spacing.h"
#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

namespace stockwork
{
using namespace dealii;

namespace
{
/// The cell of the coarse mesh that a cell has come from. (The number in its id is not that of the
/// coarse mesh but of p4est, which numbers coarse cells along a curve.)
template <int dim>
typename Triangulation<dim>::cell_iterator
coarse_cell(const Triangulation<dim> &coarse, typename Triangulation<dim>::cell_iterator cell)
{
  while (cell->level() > 0)
    cell = cell->parent();
  return {&coarse, 0, cell->index()};
}

template <typename Map>
std::string list_names(const Map &map)
{
  std::string names;
  for (const auto &entry : map)
    names += (names.empty() ? "" : ", ") + entry.first;
  return names;
}

template <typename Map>
std::vector<std::string> keys(const Map &map)
{
  std::vector<std::string> result;
  for (const auto &entry : map)
    result.push_back(entry.first);
  return result;
}
} // namespace

template <int dim>
void Geometry<dim>::declare_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("Mesh");
  // The same in two and three dimensions: there is one manual, and a deck is read before its
  // dimension is known.
  prm.declare_entry(
    "Shape", "box",
    Patterns::Selection("box|quarter disc|octant of ball|quarter ring|octant of shell|"
                        "gmsh file"),
    "Shape of the domain. Sides of a box are called left, right (across x), "
    "bottom, top (the last coordinate) and in 3-D front, back (y); those of a "
    "quarter disc (2-D) or octant of a ball (3-D) by the same names where it is "
    "cut, and surface; those of a quarter ring (2-D) or an octant of a shell (3-D) "
    "likewise, and wall inside; "
    "those of a gmsh file by its physical groups.");
  prm.declare_entry("Uniform refinements", "0", Patterns::Integer(0, 20),
                    "How many times every cell is halved in each direction.");
  prm.declare_entry("Refinement boxes", "", Patterns::Anything(),
                    "Cells that touch a box are halved until they are no larger than asked for: "
                    "'0.1 m: (0, -1) to (5, 1)', several separated by ';'.");
  prm.declare_entry("Region boxes", "", Patterns::Anything(),
                    "Cells whose centre is in a box belong to the region of this number in "
                    "subsection Rock: '1: (0, -1) to (5, 1)', several separated by ';', later ones "
                    "on top. A name instead of a number stands for the next free number.");

  prm.declare_entry(
    "Side boxes", "", Patterns::Anything(),
    "Faces of the boundary whose centre is in a box form a side of their own: 'grip: "
    "(-1 mm, 2 cm) to (1 mm, 5 cm)', several separated by ';', later ones on top.");
  prm.declare_entry("Maximum number of cells", "2000000", Patterns::Integer(1),
                    "A mesh that would have more ends the run with a message.");

  prm.enter_subsection("Box");
  prm.declare_entry("Lower corner", "", Quantities(dimension::length, Range::finite(), 0, 3),
                    "Corner with the least coordinates [m]; empty: the origin.");
  prm.declare_entry("Upper corner", "", Quantities(dimension::length, Range::finite(), 0, 3),
                    "Corner with the greatest coordinates [m]. Required for a box.");
  for (const char *entry : spacing_entry)
    prm.declare_entry(entry, "8 cells", Patterns::Anything(),
                      "Cells along the axis, before they are halved: '16 cells'; '0.5 m'; "
                      "'lines 0, 1, 2.5'; or graded, '1 cm at 0 m, growth 1.2, largest 20 m' with "
                      "a mesh line at 0 and cells of 1 cm beside it, 'around' instead of 'at' for "
                      "a cell whose middle is there ('8 cm around 0 m refined 3 times': once it "
                      "has been halved 3 times), and '1 cm from 0 m to 2 m' for a band.");
  prm.leave_subsection();

  prm.enter_subsection("Ball");
  prm.declare_entry("Radius", "", Quantity(dimension::length, Range::positive(), ""),
                    "Radius of the quarter disc or octant of a ball [m]. Required for these.");
  prm.leave_subsection();

  prm.enter_subsection("Ring");
  prm.declare_entry("Inner radius", "", Quantity(dimension::length, Range::positive(), ""),
                    "Of the quarter ring, a borehole's, or the octant of a shell, a cavity's. "
                    "Required for these.");
  prm.declare_entry("Outer radius", "", Quantity(dimension::length, Range::positive(), ""),
                    "Required for a quarter ring or an octant of a shell.");
  prm.declare_entry("Cells along the radius", "8 cells", Patterns::Anything(),
                    "As those of a box along an axis: '1 cm at 10 cm, growth 1.2, largest 20 m'.");
  prm.declare_entry("Cells along the arc", "8", Patterns::Integer(1, 100000),
                    "Of a quarter of a circle; of a shell an even number.");
  prm.leave_subsection();

  prm.enter_subsection("Gmsh");
  prm.declare_entry("File", "", Patterns::Anything(),
                    "Mesh of quadrilaterals or hexahedra written by gmsh (.msh); a relative name "
                    "starts at the deck. Physical groups name sides and regions.");
  prm.declare_entry("Scale", "1", Quantity(dimension::number, Range::positive()),
                    "Metres per unit of length in the file.");
  prm.leave_subsection();
  prm.leave_subsection();
}

template <int dim>
void Geometry<dim>::parse_parameters(ParameterHandler &prm, const std::string &deck_directory)
{
  coarse = std::make_shared<dealii::Triangulation<dim>>();
  sides.clear();
  regions.clear();

  prm.enter_subsection("Mesh");
  uniform_refinements = prm.get_integer("Uniform refinements");
  max_cells = prm.get_integer("Maximum number of cells");
  const std::string shape = prm.get("Shape");
  const std::string ball = dim == 2 ? "quarter disc" : "octant of ball",
                    ring = dim == 2 ? "quarter ring" : "octant of shell";
  if (shape != "box" && shape != "gmsh file" && shape != ball && shape != ring)
    throw EntryError("Mesh/Shape", shape,
                     "box, " + ball + ", " + ring + " or gmsh file in " +
                       (dim == 2 ? "two" : "three") + " dimensions");
  // What belongs to another shape would be dropped.
  const std::vector<std::array<std::string, 3>> of_shapes = {
    {{"Ball", "Radius", ball}}, {{"Ring", "Inner radius", ring}}, {{"Ring", "Outer radius", ring}}};
  for (const auto &[section, entry, owner] : of_shapes)
  {
    prm.enter_subsection(section);
    const std::string text = prm.get(entry);
    prm.leave_subsection();
    if (!text.empty() && shape != owner)
      throw EntryError("Mesh/" + section + "/" + entry, text,
                       "nothing (an empty entry) with 'Mesh/Shape = " + shape + "'");
  }
  if (shape == "box")
    make_box(prm);
  else if (shape == "gmsh file")
    read_gmsh(prm, deck_directory);
  else if (shape == ball)
    make_ball(prm);
  else
    make_ring(prm);
  bounds = GridTools::compute_bounding_box(*coarse);
  if (shape != "box")
    refuse_cells(coarse->n_active_cells(), uniform_refinements);
  parse_refinement(prm);
  parse_regions(prm);
  parse_sides(prm);
  prm.leave_subsection();
}

template <int dim>
void Geometry<dim>::refuse_cells(const double n_coarse, const unsigned int refinements) const
{
  const double n = std::ldexp(n_coarse, dim * refinements);
  std::ostringstream text;
  text.precision(9);
  text << "at least " << n << ", the cells of the initial mesh, unless their spacing is a mistake";
  if (n > max_cells)
    throw EntryError("Mesh/Maximum number of cells", std::to_string(max_cells), text.str());
}

namespace
{
template <int dim>
std::string example_box()
{
  return dim == 2 ? "(0, -1) to (5, 1)" : "(0, -1, -1) to (5, 1, 1)";
}
} // namespace

template <int dim>
void Geometry<dim>::parse_refinement(ParameterHandler &prm)
{
  refinement_boxes.clear();
  interpret_entry(prm, "Mesh", "Refinement boxes",
                  "a list of boxes with cell sizes, '0.1 m: " + example_box<dim>() + "'",
                  [&](const std::string &text)
                  {
                    for (const auto &item : parse_boxes<dim>(text))
                    {
                      const double size = parse_finite_quantity(item.label, dimension::length);
                      if (!(size >= 1e-6 * diameter()))
                        throw InputError("the cell size " + item.label +
                                         " is less than a millionth of the domain");
                      refinement_boxes.push_back({item.box, size});
                    }
                  });
}

template <int dim>
void Geometry<dim>::parse_regions(ParameterHandler &prm)
{
  region_boxes.clear();
  types::material_id next = 1;
  for (const auto &region : regions)
    next = std::max(next, region.second + 1);
  interpret_entry(
    prm, "Mesh", "Region boxes", "a list of numbered boxes, '1: " + example_box<dim>() + "'",
    [&](const std::string &text)
    {
      for (const auto &item : parse_boxes<dim>(text))
      {
        if (item.label.empty())
          throw InputError("a box has no name");
        const bool is_number = item.label.find_first_not_of("0123456789") == std::string::npos;
        const auto known = regions.emplace(item.label, is_number ? std::stoul(item.label) : next);
        next = std::max(next, known.first->second + 1);
        region_boxes.push_back({item.box, known.first->second, item.label});
      }
    });
}

template <int dim>
void Geometry<dim>::parse_sides(ParameterHandler &prm)
{
  side_boxes.clear();
  types::boundary_id next = 0;
  for (const auto &side : sides)
    next = std::max(next, side.second + 1);
  interpret_entry(prm, "Mesh", "Side boxes",
                  "a list of named boxes, 'grip: " + example_box<dim>() + "'",
                  [&](const std::string &text)
                  {
                    for (const auto &item : parse_boxes<dim>(text))
                    {
                      if (item.label.empty())
                        throw InputError("a box has no name");
                      const auto known = sides.emplace(item.label, next);
                      next = std::max(next, known.first->second + 1);
                      side_boxes.push_back({item.box, known.first->second, item.label});
                    }
                  });
}

template <int dim>
void Geometry<dim>::create_coarse(Triangulation &triangulation) const
{
  triangulation.copy_triangulation(*coarse);
  if (cells == Cells::curved)
  {
    TransfiniteInterpolationManifold<dim> interior;
    interior.initialize(triangulation);
    triangulation.set_manifold(interior_manifold, interior);
  }
  if (cells == Cells::ring)
  {
    if constexpr (dim == 2)
      triangulation.set_manifold(0, PolarManifold<dim>());
    else
      triangulation.set_manifold(0, SphericalManifold<dim>());
  }
  if (region_boxes.empty() && side_boxes.empty())
    return;
  const auto set = [this, &triangulation]()
  {
    set_regions(triangulation);
    set_sides(triangulation);
  };
  set();
  triangulation.signals.post_distributed_refinement.connect(set);
  triangulation.signals.post_distributed_repartition.connect(set);
  triangulation.signals.post_distributed_load.connect(set);
}

template <int dim>
void Geometry<dim>::create(Triangulation &triangulation) const
{
  create_coarse(triangulation);
  triangulation.refine_global(uniform_refinements);

  bool changed = !refinement_boxes.empty();
  while (changed)
  {
    bool any = false;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && splits(cell))
      {
        cell->set_refine_flag();
        any = true;
      }
    changed = Utilities::MPI::max(any ? 1 : 0, triangulation.get_communicator()) == 1;
    if (changed)
    {
      refuse_too_many_cells(triangulation, max_cells,
                            "unless the refinement boxes ask for smaller cells than is meant");
      triangulation.execute_coarsening_and_refinement();
    }
  }
}

template <int dim>
bool Geometry<dim>::splits(const typename dealii::Triangulation<dim>::cell_iterator &cell) const
{
  if (static_cast<unsigned int>(cell->level()) < uniform_refinements)
    return true;
  const double size = cell_size(cell);
  const double slack = 1e-8 * size; // a box that ends on a mesh line does not reach beyond it
  for (const RefinementBox &item : refinement_boxes)
    if (size > item.cell_size * (1. + 1e-8))
    {
      const auto extent = cell->bounding_box().get_boundary_points();
      const auto box = item.box.get_boundary_points();
      bool touches = true;
      for (unsigned int d = 0; d < dim; ++d)
        touches &=
          extent.first[d] < box.second[d] - slack && extent.second[d] > box.first[d] + slack;
      if (touches)
        return true;
    }
  return false;
}

template <int dim>
void Geometry<dim>::set_regions(Triangulation &triangulation) const
{
  for (const auto &cell : triangulation.active_cell_iterators())
    if (!cell->is_artificial())
      cell->set_material_id(region(cell));
}


template <int dim>
types::material_id
Geometry<dim>::region(const typename dealii::Triangulation<dim>::cell_iterator &cell) const
{
  // Children inherit from a parent that a box may have claimed: start from the coarse cell.
  types::material_id found = coarse_cell(*coarse, cell)->material_id();
  for (const RegionBox &item : region_boxes)
    if (item.box.point_inside(cell->center()))
      found = item.region;
  return found;
}


template <int dim>
void Geometry<dim>::set_sides(Triangulation &triangulation) const
{
  if (side_boxes.empty())
    return;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (!cell->is_artificial() && cell->at_boundary())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary())
        {
          // As for regions: a parent's side may have come from a box that leaves the child out.
          types::boundary_id side = coarse_cell(*coarse, cell)->face(f)->boundary_id();
          for (const SideBox &item : side_boxes)
            if (item.box.point_inside(cell->face(f)->center()))
              side = item.side;
          cell->face(f)->set_boundary_id(side);
        }
}

template <int dim>
std::unique_ptr<Mapping<dim>> Geometry<dim>::mapping() const
{
  switch (cells)
  {
  case Cells::cartesian:
    return std::make_unique<MappingCartesian<dim>>();
  case Cells::straight:
    return std::make_unique<MappingQ<dim>>(1);
  default:
    return std::make_unique<MappingQ<dim>>(2);
  }
}

template <int dim>
types::boundary_id Geometry<dim>::side(const std::string &name) const
{
  const auto found = sides.find(name);
  if (found == sides.end())
    throw InputError("the domain has no side \"" + name + "\"; its sides are " + list_names(sides));
  return found->second;
}

template <int dim>
std::vector<std::string> Geometry<dim>::side_names() const
{
  return keys(sides);
}

template <int dim>
types::material_id Geometry<dim>::region(const std::string &name) const
{
  const auto found = regions.find(name);
  if (found == regions.end())
    throw InputError("the mesh has no region \"" + name + "\"; " +
                     (regions.empty() ? "none is defined (see Mesh/Region boxes)"
                                      : "its regions are " + list_names(regions)));
  return found->second;
}

template <int dim>
std::vector<std::string> Geometry<dim>::region_names() const
{
  return keys(regions);
}

template <int dim>
Point<dim> Geometry<dim>::lower() const
{
  return bounds.get_boundary_points().first;
}

template <int dim>
Point<dim> Geometry<dim>::upper() const
{
  return bounds.get_boundary_points().second;
}

template <int dim>
double Geometry<dim>::diameter() const
{
  return lower().distance(upper());
}

template <int dim>
bool Geometry<dim>::on_side(const Point<dim> &point) const
{
  return on_side_of_box(point, lower(), upper());
}

template class Geometry<2>;
template class Geometry<3>;
} // namespace stockwork
