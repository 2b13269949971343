"""Jobs on a cluster: each file processed once, even if workers die."""
