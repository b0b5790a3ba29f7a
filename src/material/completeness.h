#pragma once

#include <string>
#include <vector>

namespace tourmaline::casefile {
struct MaterialCase;
}

namespace tourmaline::material {

/// What a material lacks of one kind of constants.
struct Gap {
  std::string kind;                    ///< as `casefile::form_of` names it, or the constant's name
  std::string words;                   ///< "piezoelectric constants"
  std::vector<std::string> constants;  ///< the keys to add
  std::string reason;                  ///< why they cannot be left out, or what else would do
};

/// What a material with its entry laid under it lacks of what its model needs, in the order of the
/// case file. Elastic
/// constants, permittivity (but of a conductor), conductivity, density, specific heat and reference
/// temperature every material has; of piezoelectric constants, thermal expansion (or stress) and
/// pyroelectric constant it has all that its class has or none; and those that its entry lists as
/// `not_given` it has without anybody having published them.
std::vector<Gap> gaps(const casefile::MaterialCase &given);

/// The keys of all gaps.
std::vector<std::string> missing_constants(const casefile::MaterialCase &given);

/// All gaps as one text, "elastic constants c12, c13; density"; empty when nothing is missing.
std::string missing_words(const casefile::MaterialCase &given);

/// Throws CaseError, which names all that is missing, unless all these materials of a case, each
/// with its entry, are complete.
void require_complete(const std::vector<casefile::MaterialCase> &materials);

}  // namespace tourmaline::material
