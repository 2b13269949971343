"""The check of faults in a recording: missing and damaged samples stay local or are flagged."""
