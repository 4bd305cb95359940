// The compiled part of toml++. The system's library is not used: it has the fault that toml.hpp corrects.
#define TOML_IMPLEMENTATION
#include "common/toml.hpp"
