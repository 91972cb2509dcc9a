#pragma once

#include <deal.II/numerics/data_postprocessor.h>

#include <map>
#include <vector>

#include "stockwork/fracture/model.h"

#include "biot/nonlinear_rock.h"

namespace stockwork
{
/// From the bulk unknowns to what a user wants to see, point by point: displacement [m], and where
/// there is a fluid, pore_pressure [Pa], effective_stress = total_stress + alpha p I, and flux
/// -(k/mu) grad(p - p_0) [m/s]. Stress is the whole of it, in-situ part included [Pa].
///
/// Where the rock may leave its linear range, also what its law remembers, the energy that it has
/// dissipated [J/m^3], and in two dimensions the stress across the plane.
///
/// In cells with extra shape functions the strain is its mean over the cell; the displacement is
/// that at the vertices, interpolated.
template <int dim>
class BulkFields : public dealii::DataPostprocessor<dim>
{
public:
  BulkFields(const MeshView<dim> &mesh_view,
             const Scene<dim> &scene,
             const FractureModel<dim> &model,
             const State &state,
             const NonlinearRock<dim> *nonlinear = nullptr);

  void evaluate_vector_field(const dealii::DataPostprocessorInputs::Vector<dim> &inputs,
                             std::vector<dealii::Vector<double>> &quantities) const override;

  std::vector<std::string> get_names() const override;

  std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation>
  get_data_component_interpretation() const override;

  dealii::UpdateFlags get_needed_update_flags() const override;

private:
  /// What rock beyond its linear range answers at an output point.
  void put_memory(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
                  const std::vector<double> &history,
                  dealii::Vector<double> &quantities,
                  unsigned int &n) const;

  double linear_stress_zz(const dealii::Point<dim> &x,
                          const RockProperties &rock,
                          const dealii::SymmetricTensor<2, dim> &strain,
                          double excess) const;

  const Scene<dim> &scene;
  const FractureModel<dim> &model;
  bool has_pore_pressure;
  const NonlinearRock<dim> *nonlinear; ///< null: linear rock
  const dealii::Mapping<dim> &mapping;
  const State state;
  std::vector<HistoryField> remembered; ///< of all laws
  bool permeability_changes = false;

  /// Mean strain of cells with extra shape functions, by active cell index.
  std::map<unsigned int, dealii::SymmetricTensor<2, dim>> mean_strain;
};
} // namespace stockwork
