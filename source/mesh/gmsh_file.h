#pragma once

#include <deal.II/base/types.h>
#include <deal.II/grid/tria.h>

#include <map>
#include <string>

namespace stockwork
{
/// Names of the physical groups of a gmsh file; a group without a name goes by its number.
struct GmshGroups
{
  std::map<std::string, dealii::types::boundary_id> sides;
  std::map<std::string, dealii::types::material_id> regions;
};

/// Read the mesh of a .msh file (format 2 or 4, text) into the empty @p triangulation.
/// @param directory where a relative file name starts
/// @throws InputError if there is no such file, or it holds something else than quadrilaterals
/// (hexahedra in 3-D) of positive volume
template <int dim>
GmshGroups read_gmsh_file(const std::string &file,
                          const std::string &directory,
                          dealii::Triangulation<dim> &triangulation);
} // namespace stockwork
