#pragma once

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <utility>
#include <vector>

#include "stockwork/fracture/model.h"

#include "biot/nonlinear_rock.h"

namespace stockwork
{
/// Writes the fields for ParaView or VisIt:
///
///   fields.pvd, vtu/fields_0012.vtu       the rock (one .vtu per rank and a .pvtu if several)
///   fracture.pvd, vtu/fracture_0012.vtu   the fracture, as lines (surfaces in 3-D)
///   bonds.pvd, vtu/bonds_0012.vtu         bonds, as lines, if the fracture model gives any
///
/// Rock: see BulkFields; region, and what the fracture model adds by cell. Fracture: what the
/// model gives, e.g. aperture, fluid_pressure, damage.
template <int dim>
class FieldOutput
{
public:
  /// Subsection Output.
  static void declare_parameters(dealii::ParameterHandler &prm);
  void parse_parameters(dealii::ParameterHandler &prm);

  /// Where to write. Collective. @throws InputError if that is not possible
  void open(const std::string &directory, MPI_Comm communicator);

  /// Should the fields of this step be written? The last step's always are, unless fields are
  /// switched off.
  bool due(unsigned int step, double time, bool is_last) const;

  /// The first time after @p time that the deck wants the fields of; infinity if there is none.
  /// Steps should end there.
  double next_time(double time) const;

  /// Of the times in the deck, those that no step of a run from @p start to @p end comes to.
  std::vector<double> times_outside(double start, double end) const;

  /// Write the fields of state.current and remember that it has been done. Collective.
  /// @throws SolveError naming the field if one has a value that is not a number
  /// @throws OutputError if a file cannot be written; those written before are complete
  void write(double time,
             const MeshView<dim> &mesh_view,
             const Scene<dim> &scene,
             const FractureModel<dim> &model,
             const State &state,
             const NonlinearRock<dim> *nonlinear = nullptr,
             const NodalFields<dim> *own_fields = nullptr);

  /// What has been written so far, for a checkpoint: a restarted run continues the series.
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &bulk_records &fracture_records &bond_records &last_time;
  }

private:
  using Records = std::vector<std::pair<double, std::string>>; ///< time, file

  void write_pvd(const std::string &name, const Records &records) const;

  bool enabled = true;
  bool higher_order_cells = true;
  unsigned int steps_between = 0;
  std::vector<double> times;

  std::string directory;
  MPI_Comm communicator = MPI_COMM_NULL;
  Records bulk_records, fracture_records, bond_records;
  double last_time = std::numeric_limits<double>::lowest(); ///< of the last fields written
};
} // namespace stockwork
