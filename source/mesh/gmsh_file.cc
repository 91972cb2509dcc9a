#include "mesh/gmsh_file.h"

#include <deal.II/grid/grid_in.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "stockwork/base/error.h"

namespace stockwork
{
namespace
{
/// The names in section $PhysicalNames of the groups of @p dimension, by number. The library reads
/// the numbers only.
std::map<unsigned int, std::string> physical_names(std::istream &file, const int dimension)
{
  std::map<unsigned int, std::string> names;
  std::string line;
  while (std::getline(file, line) && line.rfind("$PhysicalNames", 0) != 0)
  {
  }
  std::getline(file, line); // how many
  while (std::getline(file, line) && line.rfind("$EndPhysicalNames", 0) != 0)
  {
    std::istringstream entry(line);
    int group_dimension;
    unsigned int number;
    entry >> group_dimension >> number;
    const auto begin = line.find('"'), end = line.rfind('"');
    if (entry && group_dimension == dimension && begin < end)
      names[number] = line.substr(begin + 1, end - begin - 1);
  }
  return names;
}

template <typename Id>
void add_name(std::map<std::string, Id> &groups,
              const std::map<unsigned int, std::string> &names,
              const Id id)
{
  const auto name = names.find(id);
  groups[name == names.end() ? std::to_string(id) : name->second] = id;
}
} // namespace

template <int dim>
GmshGroups read_gmsh_file(const std::string &file,
                          const std::string &directory,
                          dealii::Triangulation<dim> &triangulation)
{
  const std::filesystem::path path = std::filesystem::path(directory) / file;
  std::ifstream stream(path);
  if (file.empty() || std::filesystem::is_directory(path) || !stream)
    throw InputError("there is no file " + path.string());

  dealii::GridIn<dim> reader(triangulation);
  try
  {
    reader.read_msh(stream);
  }
  catch (const dealii::ExceptionBase &error)
  {
    std::ostringstream why;
    error.print_info(why);
    throw InputError(path.string() + " cannot be read: " + why.str());
  }
  if (!triangulation.all_reference_cells_are_hyper_cube())
    throw InputError(path.string() + " contains " + (dim == 2 ? "triangles" : "tetrahedra") +
                     "; let gmsh recombine them (Mesh.RecombineAll)");

  GmshGroups groups;
  stream.clear();
  stream.seekg(0);
  const auto sides = physical_names(stream, dim - 1);
  stream.clear();
  stream.seekg(0);
  const auto regions = physical_names(stream, dim);
  for (const auto id : triangulation.get_boundary_ids())
    add_name(groups.sides, sides, id);
  for (const auto &cell : triangulation.active_cell_iterators())
    add_name(groups.regions, regions, cell->material_id());
  return groups;
}

template GmshGroups
read_gmsh_file<2>(const std::string &, const std::string &, dealii::Triangulation<2> &);
template GmshGroups
read_gmsh_file<3>(const std::string &, const std::string &, dealii::Triangulation<3> &);
} // namespace stockwork
