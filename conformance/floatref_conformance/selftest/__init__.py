"""The test of the suite: mutants must be killed, limits must hold, no false alarms."""
