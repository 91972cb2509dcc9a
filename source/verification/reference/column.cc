// Consolidation of a column along the last axis, loaded and drained at its top. Without lateral
// strain and with Poisson's ratio zero it is the rod of Sun et al., section 4.1.
#include "verification/analytical/column.h"

#include "verification/reference/problems.h"

namespace stockwork::reference
{
using namespace dealii;

namespace
{
template <int dim>
class ColumnField : public Field<dim>
{
public:
  ColumnField(const analytical::Column &column, const double top, const bool has_pore_pressure)
    : Field<dim>(has_pore_pressure)
    , column(column)
    , top(top)
  {
  }

protected:
  void
  evaluate(const Point<dim> &point, Tensor<1, dim> &displacement, double &pressure) const override
  {
    const double depth = top - point[dim - 1];
    displacement[dim - 1] = -column.displacement(depth, this->get_time());
    pressure = column.pressure(depth, this->get_time());
  }

private:
  analytical::Column column;
  double top;
};


template <int dim>
class ColumnReference : public ReferenceSolution<dim>
{
public:
  ColumnReference(const analytical::ColumnParameters &parameters,
                  const double top,
                  const bool has_pore_pressure)
    : solution(
        std::make_shared<ColumnField<dim>>(analytical::Column(parameters), top, has_pore_pressure))
  {
  }

  std::string name() const override
  {
    return "One-dimensional consolidation (Terzaghi 1923, Biot 1941)";
  }

  std::shared_ptr<Function<dim>> field() const override
  {
    return solution;
  }

private:
  std::shared_ptr<Function<dim>> solution;
};
} // namespace


template <int dim>
Made<dim> make_column(const ParameterHandler &, const ReferenceInput<dim> &input)
{
  const double length = input.upper[dim - 1] - input.lower[dim - 1];
  return std::make_unique<ColumnReference<dim>>(
    analytical::ColumnParameters{analytical::ColumnParameters::Kind::uniaxial_strain,
                                 medium(input.rock), length, -input.normal_traction("top", 0.)},
    input.upper[dim - 1], input.has_pore_pressure);
}


template Made<2> make_column<2>(const ParameterHandler &, const ReferenceInput<2> &);
template Made<3> make_column<3>(const ParameterHandler &, const ReferenceInput<3> &);
} // namespace stockwork::reference
