#include "output/fracture_fields.h"

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>

#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <sstream>

#include "output/checked_data.h"
#include "stockwork/base/error.h"

namespace stockwork
{
using namespace dealii;

namespace
{
/// Lines or surfaces, as the library's output knows them.
template <int piece_dim, int dim>
class Pieces : public DataOutInterface<piece_dim, dim>
{
public:
  explicit Pieces(const std::vector<FracturePiece<dim>> &pieces)
  {
    for (const auto &value : pieces.front().values)
      names.push_back(value.first);
    for (const FracturePiece<dim> &piece : pieces)
    {
      DataOutBase::Patch<piece_dim, dim> patch;
      constexpr unsigned int n_vertices = GeometryInfo<piece_dim>::vertices_per_cell;
      // Corners go round; the library's vertices are in lexicographic order.
      const unsigned int order[4] = {0, 1, 3, 2};
      for (unsigned int v = 0; v < n_vertices; ++v)
        patch.vertices[v] =
          piece.corners[std::min<std::size_t>(order[v], piece.corners.size() - 1)];
      patch.patch_index = patches.size();
      patch.n_subdivisions = 1;
      patch.reference_cell = ReferenceCells::template get_hypercube<piece_dim>();
      patch.data.reinit(names.size(), n_vertices);
      AssertThrow(piece.values.size() == names.size(),
                  ExcMessage("pieces of fractures with different values"));
      for (unsigned int i = 0; i < names.size(); ++i)
      {
        AssertThrow(piece.values[i].first == names[i],
                    ExcMessage("pieces of fractures with different values"));
        for (unsigned int v = 0; v < n_vertices; ++v)
          patch.data(i, v) = piece.values[i].second;
      }
      patches.push_back(std::move(patch));
    }
  }

protected:
  const std::vector<DataOutBase::Patch<piece_dim, dim>> &get_patches() const override
  {
    return patches;
  }

  std::vector<std::string> get_dataset_names() const override
  {
    return names;
  }

private:
  std::vector<std::string> names;
  std::vector<DataOutBase::Patch<piece_dim, dim>> patches;
};

template <int piece_dim, int dim>
std::string file_of(const std::vector<FracturePiece<dim>> &pieces, MPI_Comm communicator)
{
  // A fracture is small beside the bulk: one rank writes it.
  std::vector<FracturePiece<dim>> all;
  for (auto &part : Utilities::MPI::gather(communicator, pieces, 0))
    all.insert(all.end(), part.begin(), part.end());

  std::string bad, text;
  if (!all.empty())
  {
    CheckedData<Pieces<piece_dim, dim>> output(all);
    bad = output.first_not_finite();
    DataOutBase::VtkFlags flags;
    flags.print_date_and_time = false;
    flags.compression_level = decltype(flags.compression_level)::best_speed;
    output.set_flags(flags);
    std::ostringstream stream;
    output.write_vtu(stream);
    text = stream.str();
  }
  bad = Utilities::MPI::broadcast(communicator, bad, 0);
  if (!bad.empty())
    throw SolveError("The field " + bad + " of the fracture has a value that is not a number.");
  return text;
}
} // namespace


template <int dim>
std::string fracture_file(const std::vector<FracturePiece<dim>> &pieces, MPI_Comm communicator)
{
  return file_of<dim - 1, dim>(pieces, communicator);
}


template <int dim>
std::string bond_file(const std::vector<FracturePiece<dim>> &bonds, MPI_Comm communicator)
{
  return file_of<1, dim>(bonds, communicator);
}

template std::string fracture_file<2>(const std::vector<FracturePiece<2>> &, MPI_Comm);
template std::string fracture_file<3>(const std::vector<FracturePiece<3>> &, MPI_Comm);
template std::string bond_file<2>(const std::vector<FracturePiece<2>> &, MPI_Comm);
template std::string bond_file<3>(const std::vector<FracturePiece<3>> &, MPI_Comm);
} // namespace stockwork
