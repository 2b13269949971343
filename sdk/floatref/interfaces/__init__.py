"""What a plug-in sees of floatref: pipelines, hooks, adapters and profile formats."""
