"""What came of it: records, rows and the summary."""
