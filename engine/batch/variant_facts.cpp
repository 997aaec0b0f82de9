#include "batch/variant_facts.h"

#include "sphere/linear_operations.h"

namespace shoal {
namespace {

// Whether pixels hold all light that a variant is made of: those of a file, those painted of lights
// alone, and a sky's, with its lights in the picture that the manifest asks for only.
bool pixels_are_whole(const EntrySettings& settings, const Variant& variant) {
  const bool is_painted = settings.origin == LightOrigin::lights ||
                          (settings.origin == LightOrigin::sky && settings.picture);
  const SunSettings& sun = settings.projection.sun;
  return (settings.lights.empty() || is_painted) &&
         dominant_of(settings, variant) == DominantPart::keep &&
         (!sun.asked() || sun.action == SunSettings::Action::keep);
}

}  // namespace

Result<std::vector<VariantFacts>> variant_facts(const Manifest& manifest) {
  std::vector<VariantFacts> facts;
  for (const PanoramaEntry& entry : manifest.entries) {
    const EntrySettings& settings = *entry.settings;
    for (const Variant& variant : manifest.variants) {
      VariantFacts fact;
      SHOAL_ASSIGN_OR_RETURN(colour, combined_matrix(colour_of(settings, variant)));
      SHOAL_ASSIGN_OR_RETURN(turn, turn_of(settings, variant));
      fact.colour = colour;
      fact.turn = turn * mirror_of(settings, variant);
      fact.frame = frame_of(settings, variant);
      fact.is_whole = pixels_are_whole(settings, variant);
      if (fact == VariantFacts{}) continue;
      fact.panorama = entry.name;
      fact.variant = variant.name;
      facts.push_back(std::move(fact));
    }
  }
  return facts;
}

}  // namespace shoal
