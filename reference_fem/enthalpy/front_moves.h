#ifndef meltfront_reference_fem_enthalpy_front_moves_h
#define meltfront_reference_fem_enthalpy_front_moves_h

namespace meltfront::reference_fem
{
  /**
   * In which of a step's iterations fronts are moved far, while nodes are not in the
   * region of their heat: by coarse corrections, where there are coarser meshes, and by
   * Newton's steps that count the slope of the jump.
   */
  class FrontMoves
  {
  public:
    explicit FrontMoves(bool has_coarser_meshes)
      : has_coarser_meshes(has_coarser_meshes)
    {
    }

    /**
     * Whether an iteration (0, 1, ...) corrects coarsely: those from 2 on, since a front
     * within a cell or two of its place gets there by itself, and exactly; earlier ones
     * too once fronts go far.
     * @param fronts_go_far asked only where they would have to wait
     */
    template <typename FrontsGoFar>
    bool correct_coarsely(int iteration, const FrontsGoFar &fronts_go_far)
    {
      if(has_coarser_meshes && iteration < first && fronts_go_far())
        first = iteration;
      return has_coarser_meshes && iteration >= first;
    }

    /** Whether the iteration's Newton step counts the slope of the jump: that with the
     * first correction and every other one from the second after it on; from the fourth
     * where coarse corrections move fronts better. */
    bool count_slope(int iteration) const
    {
      const int since_first = iteration - first, next = has_coarser_meshes ? 4 : 2;
      return since_first == 0 || (since_first >= next && since_first % 2 == 0);
    }

  private:
    bool has_coarser_meshes;
    int first = 2; ///< of the iterations that move fronts
  };
} // namespace meltfront::reference_fem

#endif
