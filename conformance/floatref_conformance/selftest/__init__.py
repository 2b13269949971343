"""The suite under test: mutants that must be killed, limits that must hold, no false alarms."""
