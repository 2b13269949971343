"""The results: records, rows and the summary."""
