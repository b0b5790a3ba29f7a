#pragma once

/// Ends the process with exit status 4 and a sentence where a limit (ulimit) is too tight for the
/// libraries to start, and has it end so where it uses up its processor time. Every process does so
/// at its start, before all constructors; a copy of one has to ask, as neither timers nor what
/// others use by then are copied.
void look_at_limits(char **environment);
