"""Jobs on a cluster: each file processed once, whatever happens to workers."""
