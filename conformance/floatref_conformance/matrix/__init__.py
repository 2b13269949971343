"""Results of several devices or editions beside each other: rows are checks, columns reports."""
