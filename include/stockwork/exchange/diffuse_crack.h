#pragma once

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/distributed/tria.h>

#include <boost/serialization/vector.hpp>

#include "stockwork/exchange/collectives.h"
#include "stockwork/exchange/scene.h"
#include "stockwork/exchange/segment.h"

#include <functional>
#include <map>
#include <vector>

namespace stockwork
{
/// A crack that is wider than a cell and has no faces, such as a damage field, as the fluid sees
/// it; in the plane. *Stations* stand in a row along it, and the cells that are nearest to one are
/// a piece of the crack: a segment, which may reach over several ranks. What a piece is made of,
/// its cells know, and say in a Piece; where the crack is, the model says. Stations are the same on
/// every rank, and so is what is asked for below, but for segments().
template <int dim>
class DiffuseCrack
{
public:
  using Triangulation = dealii::parallel::distributed::Triangulation<dim>;

  /// What the owned cells of a station add up to.
  struct Piece
  {
    double area = 0.; ///< of the crack [m^2]; [m] in 2-D

    /// What has most of it along the crack's normal, summed: of a field, the square of its slope.
    dealii::SymmetricTensor<2, dim> across;

    /// Of a unit of each of the bulk's unknowns: the volume of the piece [m^2]; [m] in 2-D.
    std::map<dealii::types::global_dof_index, double> volume;
  };

  /// Stations along cracks of the scene.
  /// @param distance of stations [m]
  /// @param reach of the crack: how far its cells are from a station at most [m]
  void begin(const std::vector<InitialCrack<dim>> &cracks, double distance, double reach);

  /// Find what cells belong to; where the crack has come to places that are farther than the
  /// distance from all stations, with new ones there.
  /// @param broken this rank's
  void extend(const std::vector<dealii::Point<dim>> &broken,
              const Triangulation &triangulation,
              const Collectives &collectives);

  /// List the segments of the pieces, one of each station.
  void list_segments(const std::vector<Piece> &pieces,
                     const Triangulation &triangulation,
                     const std::function<double(const dealii::Point<dim> &)> &pore_pressure,
                     const Collectives &collectives);

  const std::vector<dealii::Point<dim>> &stations() const
  {
    return places;
  }

  /// Station of an owned or ghost cell; -1: the crack is far.
  int station(const unsigned int active_cell_index) const
  {
    return of_cells.empty() ? -1 : of_cells[active_cell_index];
  }

  /// Unit normal of the crack at a station.
  const dealii::Tensor<1, dim> &normal(const unsigned int station) const
  {
    return normals[station];
  }

  std::uint64_t key(unsigned int station) const;

  /// Those with cells on this rank.
  const std::vector<Segment<dim>> &segments() const
  {
    return all_segments;
  }

  /// Stations that are new in the step.
  unsigned int n_new() const
  {
    return places.size() - n_committed;
  }

  void commit()
  {
    n_committed = places.size();
  }

  /// What cells belong to is to be found again.
  void rollback()
  {
    places.resize(n_committed);
  }

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &places &n_committed &distance &reach;
  }

private:
  std::vector<std::vector<typename Segment<dim>::Neighbour>>
  neighbours(const Triangulation &triangulation, const Collectives &collectives) const;

  double distance = 0., reach = 0.;       ///< see begin()
  std::vector<dealii::Point<dim>> places; ///< those of the step last
  unsigned int n_committed = 0;
  std::vector<int> of_cells; ///< see station()
  std::vector<dealii::Tensor<1, dim>> normals;
  std::vector<Segment<dim>> all_segments;
};


/// Whether a crack of the scene passes a cell, so that the cells which it passes are one row along
/// it and end with it: the cell's centre is beside the crack, not beyond its end, and near. Of the
/// two cells at a crack along their edge, it is the one to the right or above.
/// @param size of the cell [m]
template <int dim>
bool passes(const InitialCrack<dim> &crack, const dealii::Point<dim> &centre, double size);
} // namespace stockwork
