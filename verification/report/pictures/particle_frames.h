#ifndef meltfront_verification_report_pictures_particle_frames_h
#define meltfront_verification_report_pictures_particle_frames_h

#include <verification/record/run_record.h>
#include <verification/record/stored_case.h>
#include <verification/report/page/markup.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /** Colours of a drawing: of the page, which follow light and dark, or of a file. */
  struct DrawingColours
  {
    std::string ink, muted, solid, liquid, page;

    static DrawingColours of_page();
    static DrawingColours of_file();
  };

  /**
   * Draws particles of a solid as D. Greenspan drew them in 1976: line segments between
   * solid particles nearer than the force reaches, fluid ones as points, those among them
   * that move faster than 7.5 with an arrow of their direction; the base, the source as a
   * star, and the particles' numbers where there are at most 50. Particles of space are
   * balls, the nearer in front of the farther.
   */
  class FrameDrawing
  {
  public:
    /**
     * @param record of a case of particle solids
     * @param frames what the window is chosen from: it holds all of them, but for
     * particles that fly farther than 1.3 of the solid's width beside it
     */
    FrameDrawing(const StoredCase &record, const std::vector<ParticleFrame> &frames,
                 const DrawingColours &colours);

    double width() const;
    double height() const;

    /** What all frames share, as SVG. */
    std::string background() const;

    /** One frame as SVG, with its step and its number of solid particles below. */
    std::string frame(const ParticleFrame &frame) const;

  private:
    struct Point
    {
      double x, y;
    };

    Point place(double x, double y) const;
    bool visible(const Point &point) const;
    std::string balls(const ParticleFrame &frame) const;
    std::string rays() const;
    std::string bonds(const ParticleFrame &frame) const;
    std::string particles(const ParticleFrame &frame, double wanted) const;
    std::string arrows(const ParticleFrame &frame) const;
    std::string numbers(const ParticleFrame &frame) const;
    std::string words(const ParticleFrame &frame) const;

    const cases::ParticleSolid &solid;
    double radius; ///< of a particle
    DrawingColours colours;
    double x0, x1, y0, y1; ///< the window
    double scale;          ///< units of the picture per length
  };

  /** The run whose frames are shown: the first that finished and has any; else null. */
  const RunRecord *run_with_frames(const std::vector<const RunRecord *> &runs);

  /** All frames of a run in a grid, as a part of the page. */
  Markup frames_in_page(const StoredCase &record, const RunRecord &run);

  /** The same as a file of its own. */
  std::string frames_as_file(const StoredCase &record,
                             const std::vector<ParticleFrame> &frames);

  /**
   * The frames of a run one after another at one place, by the style sheet alone; the
   * last one where less motion is preferred and on paper. Fewer of them the more
   * particles there are; nothing for fewer than ten.
   */
  Markup animation_in_page(const StoredCase &record, const RunRecord &run);

  /** Rules of the style sheet for frames. */
  const char *frame_style();
} // namespace meltfront::verification

#endif
