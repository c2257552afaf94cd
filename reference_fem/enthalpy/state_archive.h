#ifndef meltfront_reference_fem_enthalpy_state_archive_h
#define meltfront_reference_fem_enthalpy_state_archive_h

// What checkpoints of both engines are written with.

#include <cases/method.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/vector.hpp>

namespace boost::serialization
{
  template <class Archive>
  void serialize(Archive &archive, meltfront::cases::EffectCost &cost, unsigned int)
  {
    archive &cost.effect &cost.calls &cost.bytes &cost.seconds;
  }
} // namespace boost::serialization

namespace meltfront::reference_fem
{
  /** Why a run that nobody keeps states of is refused. */
  inline constexpr const char *checkpoints_are_of_single_runs
      = "fem-enthalpy keeps checkpoints (checkpoint) of single runs only, those of "
        "`meltfront run`";
} // namespace meltfront::reference_fem

#endif
