#pragma once

#include "discontinuity/contact_law.h"
#include "discontinuity/stress_ahead.h"
#include "fracture/damage/band.h"
#include "fracture/damage/law.h"
#include "fracture/damage/parameters.h"
#include "stockwork/fracture/model.h"

#include <map>
#include <string>
#include <vector>

namespace stockwork::damage
{
/// Cracks as bands of damaged cells, in two and three dimensions and without a path to follow: a
/// cell beside the band cracks where the stress across it, with the fluid's pressure, exceeds the
/// strength. After Zhang et al. (2022) in the form of a crack band; see README.md.
template <int dim>
class Damage : public FractureModel<dim>
{
public:
  using typename FractureModel<dim>::CellIterator;

  Damage(const Parameters &parameters, const Scene<dim> &scene);

  Requirements requirements() const override
  {
    Requirements needs;
    needs.random_rock = true;
    needs.pore_pressure = needs.fluid_in_pores = parameters.tensor_fluid;
    needs.symmetric = !parameters.tensor_fluid && !(parameters.friction > 0.);
    needs.breaks_between_steps = true;
    needs.may_grow = needs.lets_cells_merge = parameters.growth;
    return needs;
  }

  void setup(const MeshView<dim> &mesh_view, const Collectives &collectives) override;

  void begin_step(const StepContext &context) override;

  std::vector<ExtraUnknown> extra_unknowns() const override
  {
    return band.unknowns();
  }

  dealii::ArrayView<const Segment<dim>> segments() const override
  {
    return dealii::make_array_view(all_segments);
  }

  CellRole<dim> role(const CellIterator &cell) const override
  {
    return {band.cut_cell(cell->active_cell_index())};
  }

  void assemble(const StepContext &context, const State &state, Sink &sink) const override;

  Verdict
  advance(const StepContext &context, const State &state, const Collectives &collectives) override;

  bool commit(const StepContext &context, const State &state) override;

  void rollback() override;

  void wanted_cell_size(const dealii::parallel::distributed::Triangulation<dim> &triangulation,
                        std::vector<float> &sizes) const override;

  double tensile_strength() const override
  {
    const auto law = laws.find(0);
    return law == laws.end() ? std::numeric_limits<double>::quiet_NaN() : law->second.strength;
  }

  std::vector<std::string> take_messages() override;

  void save(boost::archive::binary_oarchive &archive) const override;

  void load(boost::archive::binary_iarchive &archive) override;

  FractureSummary summary(const State &state, const Collectives &collectives) const override;

  void write_fields(const State &state, FieldSink<dim> &sink) const override;

private:
  /// The segments of the band as the fluid is to see them, and the springs, after the band has
  /// changed.
  void find_segments();

  void start(const Collectives &collectives);

  /// Refuse rock so weak that its process zone is longer than the domain.
  void check_strengths() const;

  /// The law of a region whose cells along the crack are of this size; says what is coarse.
  void choose_strength(dealii::types::material_id region, double size);

  SeamLaw law_of(const RockProperties &rock, double strength) const;

  /// The law of a crack: that of its region, where the rock varies that of its place.
  SeamLaw law(const CrackCell<dim> &crack) const;

  /// D of the whole cell.
  double damage(const CrackCell<dim> &crack) const;

  /// Modulus of uniaxial strain across the crack over the size of the cell [Pa/m].
  double rock_stiffness(const CrackCell<dim> &crack) const;

  ContactLaw contact_law(const CrackCell<dim> &crack) const;

  /// Let a crack of the scene carry what the rock there carried in situ, so that nothing moves
  /// until something changes: faces by what presses them, a seam whatever it is.
  void press_in_situ(CrackCell<dim> &crack) const;

  /// What the faces of a cell exert on one another. Each cell has one gap, its mean aperture,
  /// which is the fluid's as well.
  ContactResponse<dim> contact(const CrackCell<dim> &crack,
                               const dealii::Tensor<1, dim> &jump) const;

  /// Share of a cell that has no strength left and rubs where its faces touch, of the last step.
  double broken_share(const CrackCell<dim> &crack) const;

  /// A jump of a seam, counted from where the faces that it holds press one another no more.
  dealii::Tensor<1, dim> seam_jump(const CrackCell<dim> &crack,
                                   const dealii::Tensor<1, dim> &jump) const;

  /// What the rock carries across the crack at one of its points.
  SeamResponse<dim>
  seam(const CrackCell<dim> &crack, unsigned int point, const dealii::Tensor<1, dim> &jump) const;

  /// What holds a cell's slip to that of a neighbour, see slip_springs().
  struct SlipSpring
  {
    unsigned int cell, other;                  ///< numbers of the two
    double side;                               ///< -1 where its plus side is this one's minus side
    dealii::SymmetricTensor<2, dim> stiffness; ///< [N/m]
  };

  /// Of the band as it is.
  std::vector<SlipSpring> slip_springs() const;

  void hold_stairs(const State &state, Sink &sink) const;

  /// By how much the slip of its cells differs [m].
  dealii::Tensor<1, dim> difference(const SlipSpring &spring,
                                    const std::vector<double> &extra) const;

  /// Stored in it [J].
  double energy_of(const SlipSpring &spring, const std::vector<double> &extra) const;

  /// Whether faces overlap too much, which then carry more: the step is to be solved again.
  bool press_faces(const State &);

  /// A whole cell beside the band into which a crack runs.
  struct Candidate
  {
    CrackCell<dim> cell;
    std::vector<unsigned int> behind;       ///< numbers of cracked cells
    std::vector<unsigned int> faces_behind; ///< of these, the face to the candidate
    bool fits = true;                       ///< its size is that of the cells behind

    template <class Archive>
    void serialize(Archive &ar, const unsigned int)
    {
      ar &cell &behind &faces_behind &fits;
    }
  };

  /// The same on all ranks, in the same order.
  std::vector<Candidate> candidates(const Collectives &collectives) const;

  /// Share of a front cell to which the fluid has come, above 1 where it would be beyond. It is
  /// there, unless there is suction in it, as in viscous fluid, and the rock is bare to there. Then
  /// from what it and its neighbour hold, with the opening x^(2/3) of such a tip (Desroches et al.
  /// 1994).
  double reached_share(unsigned int number, const State &state) const;

  /// In-situ compression across a cracked cell [Pa].
  double closing_stress(const CrackCell<dim> &crack) const;

  /// What a candidate grows out of.
  struct Behind
  {
    bool opens = false;   ///< its seam has begun to soften
    bool broken = false;  ///< nothing is left of its seam
    double pressure = 0.; ///< of the fluid [Pa]
    double net = 0.;      ///< magnitude, over the stress that closes the crack [Pa]
    double reached = 0.;  ///< see reached_share()
  };
  Behind look_behind(const Candidate &candidate, const State &state) const;

  /// The rock ahead of each candidate, twice: for whether it cracks, and for the direction.
  std::vector<RockAhead<dim>> look_ahead(const std::vector<Candidate> &all,
                                         const State &state,
                                         const Collectives &collectives) const;

  /// Stress ahead of a candidate and pressure behind it, over the threshold at which it cracks.
  double drive(const Candidate &candidate,
               const Behind &behind,
               const dealii::SymmetricTensor<2, dim> &stress);

  /// Whether a candidate that is driven enough cracks.
  /// Notes in `arrested` if it does not although pressure and tension are hopelessly much.
  bool may_crack(const Candidate &candidate, const Behind &behind);

  /// Cells by which the front has advanced in this step, as the length of the next should see it:
  /// none where few of those that were near to it have cracked ('Front share per step').
  unsigned int front_advances() const;

  /// A fracture that the fluid has grown has nowhere to go, and takes more of it all the same.
  bool swells_in_vain(const State &state) const;

  /// Put the crack into a candidate, across this direction of greatest tension.
  /// @param beside that crack in the same pass
  void crack(Candidate &candidate,
             const dealii::Tensor<1, dim> &across,
             const std::vector<CrackCell<dim>> &beside) const;

  /// A larger cell does not resolve the process zone, unless it was so from the start [m].
  double largest_cell(const CrackCell<dim> &crack) const;

  Parameters parameters;
  const Scene<dim> &scene;
  std::map<dealii::types::material_id, SeamLaw> laws;
  Band<dim> band;
  std::unique_ptr<MeshView<dim>> mesh_view;
  std::vector<Segment<dim>> all_segments;
  std::vector<SlipSpring> springs; ///< of the band as it is
  std::vector<std::string> messages;

  // History, the same on all ranks.
  std::vector<CrackCell<dim>> committed;
  unsigned int n_initial = 0;   ///< cells of the scene's own cracks
  double initial_size = 0.;     ///< of the largest of them [m]
  bool started = false;         ///< a step has been accepted
  unsigned int n_arrested = 0;  ///< steps for which nothing has grown, though hopelessly driven
  bool waits_for_mesh = false;  ///< cells ahead were of another size
  double greatest_opening = 0.; ///< of all cells so far [m]
  bool touched = false, said = false; ///< broken faces touch; the user has been told
  double dissipated = 0.;             ///< since the start [J], [J/m] in 2-D

  // Of the current step.
  unsigned int n_presses = 0, n_advances = 0;
  unsigned int n_moving = 0; ///< candidates that were at half of their threshold or beyond
  unsigned int n_cracked = 0;
  bool needs_mesh = false, arrested = false;
  dealii::Point<dim> misfit; ///< where cells of another size are in the crack's way
  std::size_t n_messages_before = 0;
  std::map<dealii::types::material_id, SeamLaw>
    laws_before; ///< so that what was said is said again
};
} // namespace stockwork::damage
