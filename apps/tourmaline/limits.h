#pragma once

/// What every process does at its start, before all constructors, a copy of one (fork) has to ask
/// for: ends it with exit status 4 and a sentence where it may start too few processes and threads,
/// or once its processor time is used up. All other limits (ulimit) its libraries have survived.
void look_at_limits_of_copy(char **environment);
