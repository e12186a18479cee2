"""What a clip lacks: embedded estimators and adapters to external models."""
